// What the writers of EVT2, EVT2.1 and EVT4 share: fields of the same widths, and words for the upper bits of
// the time.
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "io/base/checked_sink.h"
#include "io/base/prophesee_header.h"
#include "io/evt/evt2.h"

namespace scarf {

class Evt2FieldsWriter : public CheckedSink {
 protected:
  Evt2FieldsWriter(std::string_view format, ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor,
                    {.format = format,
                     .t_min = 0,
                     .t_end = evt2::kTimeEnd,
                     .max_coordinate = evt2::kCoordinateMask,
                     .trigger_inputs = evt2::kTriggerInputMask + 1,
                     .header = true}),
        format_(format),
        sensor_(sensor) {}

  /// A word with the upper bits of the time.
  virtual void put_time_high(uint32_t high) = 0;
  virtual void put_trigger(uint32_t fields) = 0;

  /// Writes what the time needs of its upper bits; returns the lower ones, for the event.
  uint32_t set_time(int64_t t) {
    return clock_.set(t, [this](uint32_t high) { put_time_high(high); });
  }

  void encode_header(std::span<const HeaderLine> lines) final {
    output_.append(prophesee_header_text(format_, sensor_, lines));
  }

  void encode_trigger(const Trigger& trigger) final {
    put_trigger(set_time(trigger.t) << 22 | uint32_t{trigger.id} << 8 | trigger.value);
  }

 private:
  std::string_view format_;
  SensorSize sensor_;
  evt2::HeldClock clock_;
};

}  // namespace scarf
