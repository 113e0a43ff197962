// What the formats of Prophesee RAW have in common, whatever their words are.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "io/base/format.h"
#include "io/base/sensor_size.h"
#include "io/evt/evt2.h"
#include "io/evt/word_guess.h"
#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"

namespace scarf {

/// A reader of words behind a header, which may say the size of the sensor. Errors: bad_input, if the options
/// say another one.
template <class Reader>
Result<std::unique_ptr<EventSource>> open_evt(Input input, const ReadOptions& options) {
  const auto sensor = agreed_sensor(input.header ? input.header->sensor : std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(std::make_unique<Reader>(std::move(input), *sensor, options));
}

/// Whether bytes without a header are words of this format, and of no other.
template <const std::string_view& kFormatName>
bool recognise_evt(const Beginning& beginning) {
  return beginning.last && guess_words(beginning.bytes) == kFormatName;
}

template <const std::string_view& kFormatName>
constexpr Format evt_format(std::string_view title, decltype(Format::open) open,
                            decltype(Format::create) create, decltype(Format::open_triggers) open_triggers) {
  return {.name = kFormatName,
          .title = title,
          .options = kTakesFirstHigh,
          .prophesee = true,
          .recognise = recognise_evt<kFormatName>,
          .open = open,
          .create = create,
          .open_triggers = open_triggers,
          .writes_header = true,
          .writes_triggers = true};
}

/// The trigger of a word of EVT2 or EVT4, or of the upper half of one of EVT2.1.
inline Trigger evt2_trigger(const evt2::Clock& clock, uint32_t word) {
  return {clock.time(word >> 22), static_cast<uint16_t>(word >> 8 & evt2::kTriggerInputMask),
          static_cast<uint8_t>(word & 1)};
}

}  // namespace scarf
