// Reader of EVT2.1 words.

#include <algorithm>
#include <optional>
#include <utility>

#include "core/text.h"
#include "io/base/buffered_source.h"
#include "io/base/decoded_triggers.h"
#include "io/base/known_formats.h"
#include "io/base/sensor_size.h"
#include "io/base/writers.h"
#include "io/evt/evt21.h"
#include "io/evt/evt_format.h"
#include "io/evt/pixel_mask.h"
#include "io/evt/word_check.h"
#include "io/evt/word_guess.h"

namespace scarf {
namespace {

using evt21::ByteOrder;

constexpr std::string_view kName = "evt21";

std::string_view order_name(ByteOrder order) {
  return order == ByteOrder::little ? "little" : "legacy";
}

class Evt21Reader final : public BufferedSource {
 public:
  Evt21Reader(Input input, std::optional<SensorSize> sensor, const ReadOptions& options, ByteOrder order,
              std::string damage)
      : BufferedSource(std::move(input), sensor, options), order_(order) {
    if (!damage.empty()) tally_.note_damage(0, std::move(damage));
  }

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  ByteOrder order_;
  evt2::Clock clock_;
  PixelMask vector_;  // events of the last word that did not fit the output yet
};

BufferedSource::Decoded Evt21Reader::decode(std::span<const uint8_t> bytes, bool /*last*/,
                                            std::span<Event> out) {
  size_t count = vector_.write(out);
  size_t at = 0;
  for (; count < out.size() && at + evt21::kWordBytes <= bytes.size(); at += evt21::kWordBytes) {
    const uint64_t word = evt21::load_word(bytes.data() + at, order_);
    const auto type = static_cast<uint32_t>(word >> 60);
    const auto upper = static_cast<uint32_t>(word >> 32);
    if (type == evt21::kTimeHigh) {
      clock_.set_high(upper);
    } else if (clock_.started() && type <= evt21::kPositive) {
      vector_ = {static_cast<uint32_t>(word),
                 {clock_.time(upper >> 22), static_cast<uint16_t>(upper >> 11 & evt2::kCoordinateMask),
                  static_cast<uint16_t>(upper & evt2::kCoordinateMask), static_cast<uint8_t>(type)}};
      count += vector_.write(out.subspan(count));
    } else if (clock_.started() && type != evt21::kTrigger && type != evt21::kOthers &&
               type != evt21::kContinued) {
      ++tally_.report.unknown_words;
    }
  }
  if (clock_.started()) tally_.set_first_high(clock_.first_high());
  return {at, tally_.keep(out.first(count)), count < out.size()};
}

// How a recording's words lie: as they look, if they look like one order; else as the header says.
struct Order {
  ByteOrder order;
  std::string damage;  // the header says something else; empty if not
};

Result<Order> order_of(Input& input) {
  constexpr size_t kLookedAt = 4096 * evt21::kWordBytes;
  if (const auto filled = input.bytes.fill(kLookedAt); !filled) return filled.error();
  const auto bytes = input.bytes.available();
  const auto seen = looks_like_evt21(bytes.first(std::min(bytes.size(), kLookedAt)));
  if (!input.header) return Order{seen.value_or(ByteOrder::little), ""};
  const ByteOrder said = input.header->byte_order;
  if (!seen || *seen == said) return Order{said, ""};
  return Order{*seen, text("the header says or implies endianness ", order_name(said),
                           ", but the words are in that called ", order_name(*seen), " and are read so")};
}

Result<std::unique_ptr<EventSource>> open_evt21(Input input, const ReadOptions& options) {
  const auto sensor = agreed_sensor(input.header ? input.header->sensor : std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  auto order = order_of(input);
  if (!order) return order.error();
  return std::unique_ptr<EventSource>(std::make_unique<Evt21Reader>(std::move(input), *sensor, options,
                                                                    order->order, std::move(order->damage)));
}

class Evt21Triggers {
 public:
  explicit Evt21Triggers(ByteOrder order) : order_(order) {}

  std::optional<Trigger> take(uint64_t word) {
    // The upper half, in which all fields of time words and triggers lie.
    const auto upper = static_cast<uint32_t>(order_ == ByteOrder::legacy ? word : word >> 32);
    const uint32_t type = upper >> 28;
    if (type == evt21::kTimeHigh) clock_.set_high(upper);
    if (type != evt21::kTrigger || !clock_.started()) return std::nullopt;
    return evt2_trigger(clock_, upper);
  }

 private:
  ByteOrder order_;
  evt2::Clock clock_;
};

Result<std::unique_ptr<TriggerSource>> open_evt21_triggers(Input input, const ReadOptions& options) {
  const auto order = order_of(input);
  if (!order) return order.error();
  return make_decoded_triggers(std::move(input), options,
                               TriggersByWord<uint64_t, Evt21Triggers>(Evt21Triggers(order->order)));
}

bool looks_like(std::span<const uint8_t> bytes, ByteOrder order) {
  WordCheck<evt2::kTimeHighBits> check;
  for (size_t at = 0; at + evt21::kWordBytes <= bytes.size(); at += evt21::kWordBytes) {
    const uint64_t word = evt21::load_word(bytes.data() + at, order);
    switch (word >> 60) {
      case evt21::kNegative:
      case evt21::kPositive:
        check.event();
        break;
      case evt21::kTimeHigh:
        check.time_high(static_cast<uint32_t>(word >> 32) & (evt2::TimeHigh::kRange - 1));
        break;
      case evt21::kTrigger:
      case evt21::kOthers:
      case evt21::kContinued:
        check.other();
        break;
      default:
        check.undefined();
    }
  }
  return check.plausible(evt2::kTimeHighsPerSecond);
}

}  // namespace

std::optional<ByteOrder> looks_like_evt21(std::span<const uint8_t> bytes) {
  const bool little = looks_like(bytes, ByteOrder::little);
  const bool legacy = looks_like(bytes, ByteOrder::legacy);
  if (little == legacy) return std::nullopt;
  return little ? ByteOrder::little : ByteOrder::legacy;
}

const Format kEvt21Format =
    evt_format<kName>("Prophesee RAW, EVT2.1", open_evt21, create_evt21, open_evt21_triggers);

}  // namespace scarf
