// Writer of EVT3: a word for what changed, and vectors where they are shorter than single events.
#include <algorithm>
#include <optional>
#include <utility>

#include "io/base/checked_sink.h"
#include "io/base/prophesee_header.h"
#include "io/base/writers.h"
#include "io/evt/evt3.h"
#include "io/evt/pixel_run.h"

namespace scarf {
namespace {

constexpr int64_t kTimeEnd = static_cast<int64_t>(kMaxLoops << (evt3::kTimeHighBits + evt3::kTimeLowBits));

// Vectors come as VECT_12, VECT_12, VECT_8 within the sensor: the only ones that every known reader accepts.
constexpr uint32_t kVectorLength = 32;
constexpr size_t kFewestInVector = 5;  // of 4 words

class Evt3Writer final : public CheckedSink {
 public:
  Evt3Writer(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor,
                    {.format = "evt3",
                     .t_min = 0,
                     .t_end = kTimeEnd,
                     .max_coordinate = evt3::kCoordinateMask,
                     .trigger_inputs = evt3::kTriggerInputMask + 1,
                     .header = true}),
        sensor_(sensor),
        last_base_(std::min<int32_t>(sensor.width, evt3::kCoordinateMask + 1) -
                   static_cast<int32_t>(kVectorLength)) {}

 protected:
  void encode_header(std::span<const HeaderLine> lines) override {
    output_.append(prophesee_header_text("evt3", sensor_, lines));
  }

  void encode_trigger(const Trigger& trigger) override {
    set_time(static_cast<uint64_t>(trigger.t));
    put(evt3::kTrigger, uint32_t{trigger.id} << 8 | trigger.value);
  }

  void encode(std::span<const Event> events) override {
    while (!events.empty()) {
      const Event& first = events.front();
      set_time(static_cast<uint64_t>(first.t));
      set_row(first.y);
      const size_t run = last_base_ >= 0 ? pixel_run(events, base_of(first.x) + kVectorLength) : 0;
      if (run >= kFewestInVector) {
        put_vector(events.first(run));
      } else {
        put(evt3::kAddrX, uint32_t{first.p} << 11 | first.x);
      }
      events = events.subspan(run >= kFewestInVector ? run : 1);
    }
  }

 private:
  struct VectorBase {
    uint32_t x;
    uint32_t p;
    friend bool operator==(const VectorBase&, const VectorBase&) = default;
  };

  // The base of a vector that holds pixel x.
  uint32_t base_of(uint32_t x) const { return std::min(x, static_cast<uint32_t>(last_base_)); }

  void put_vector(std::span<const Event> events) {
    const VectorBase base{base_of(events.front().x), events.front().p};
    if (base_ != base) put(evt3::kVectBaseX, base.p << 11 | base.x);
    const uint32_t mask = pixel_bits(events, base.x);
    put(evt3::kVect12, mask & 0xFFF);
    put(evt3::kVect12, mask >> 12 & 0xFFF);
    put(evt3::kVect8, mask >> 24);
    base_ = VectorBase{base.x + kVectorLength, base.p};
  }

  void set_time(uint64_t t) {
    const uint64_t high = t >> evt3::kTimeLowBits;
    const uint32_t low = t & evt3::kPayloadMask;
    if (high != high_) {
      carry_high_counter<evt3::kTimeHighBits>(high_, high,
                                              [&](uint32_t value) { put(evt3::kTimeHigh, value); });
      high_ = high;
      low_.reset();  // some readers keep it, others set it to 0
    }
    if (low != low_) {
      put(evt3::kTimeLow, low);
      low_ = low;
    }
  }

  void set_row(uint32_t y) {
    if (y == y_) return;
    put(evt3::kAddrY, y);
    y_ = y;
  }

  void put(evt3::Type type, uint32_t payload) {
    output_.append_word(static_cast<uint16_t>(uint32_t{type} << 12 | payload));
  }

  SensorSize sensor_;
  int32_t last_base_;  // the rightmost one with the whole vector inside the sensor; negative if there is none
  // What a reader holds after the words so far.
  std::optional<uint64_t> high_;  // its TIME_HIGH counter, wraps included
  std::optional<uint32_t> low_;
  std::optional<uint32_t> y_;
  std::optional<VectorBase> base_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt3(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  return create_sink<Evt3Writer>(path, sensor, rule);
}

}  // namespace scarf
