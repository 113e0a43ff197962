// Reader of DAT records.

#include <optional>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/buffered_source.h"
#include "io/base/decoded_triggers.h"
#include "io/base/known_formats.h"
#include "io/base/put_event.h"
#include "io/base/sensor_size.h"
#include "io/base/writers.h"
#include "io/records/dat.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "dat";

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

// Where the fields of a record's second word lie.
struct Layout {
  uint32_t x_mask;
  int y_shift;
  uint32_t y_mask;
  int p_shift;
  uint32_t p_mask;
};
constexpr Layout kVersion1 = {0x1FF, 9, 0xFF, 17, 1};
constexpr Layout kVersion2 = {0x3FFF, 14, 0x3FFF, 28, 0xF};

class DatReader final : public BufferedSource {
 public:
  DatReader(Input input, std::optional<SensorSize> sensor, const ReadOptions& options, const Layout& layout)
      : BufferedSource(std::move(input), sensor, options), layout_(layout) {}

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool /*last*/, std::span<Event> out) override {
    const Layout layout = layout_;  // copies, for the compiler to hold in registers
    dat::Clock clock = clock_;
    const size_t count = std::min<size_t>(out.size(), bytes.size() / dat::kRecordBytes);
    for (size_t i = 0; i < count; ++i) {
      const auto record = load_little_endian<uint64_t>(bytes.data() + i * dat::kRecordBytes);
      const auto word = static_cast<uint32_t>(record >> 32);
      put_event(out[i], clock.unwrap(static_cast<uint32_t>(record)), word & layout.x_mask,
                word >> layout.y_shift & layout.y_mask,
                (word >> layout.p_shift & layout.p_mask) != 0 ? 1 : 0);
    }
    clock_ = clock;
    return {count * dat::kRecordBytes, tally_.keep(out.first(count)), count < out.size()};
  }

 private:
  Layout layout_;
  dat::Clock clock_;
};

// What the two bytes behind the header say. Files without a header have none of them.
Result<uint8_t> take_type(Input& input) {
  if (!input.header) return uint8_t{dat::kEvent2d};
  if (const auto filled = input.bytes.fill(2); !filled) return filled.error();
  const auto bytes = input.bytes.available();
  if (bytes.size() < 2) return bad("the DAT file ends where the type of its records should be");
  const uint8_t type = bytes[0];
  if (bytes[1] != dat::kRecordBytes) {
    return bad(text("the DAT file has records of type ", int{type}, " with ", int{bytes[1]},
                    " bytes; scarf reads those of ", dat::kRecordBytes, " bytes"));
  }
  input.bytes.skip(2);
  return type;
}

Result<const Layout*> layout_of(const Input& input, uint8_t type) {
  if (!input.header) return &kVersion1;
  const auto version = input.header->dat_version;
  if (version == 2 || (!version && type == dat::kEventCd)) return &kVersion2;
  if (version == 1) return &kVersion1;
  if (!version) {
    return bad(
        "the DAT header has no Version; add the line '% Version 1' (x of 9 bits) or '% Version 2' (x of 14)");
  }
  return bad(text("the DAT header says Version ", *version, "; scarf reads 1 and 2"));
}

Result<std::unique_ptr<EventSource>> open_dat(Input input, const ReadOptions& options) {
  const auto sensor = agreed_sensor(input.header ? input.header->sensor : std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  const auto type = take_type(input);
  if (!type) return type.error();
  if (*type == dat::kTrigger) {
    return Error{ErrorCode::unrecognised,
                 "the DAT file holds triggers, no events; open_triggers() reads them"};
  }
  if (*type != dat::kEvent2d && *type != dat::kEventCd) {
    return bad(
        text("the DAT file holds records of type ", int{*type}, "; scarf reads events, types 0 and 12"));
  }
  const auto layout = layout_of(input, *type);
  if (!layout) return layout.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<DatReader>(std::move(input), *sensor, options, **layout));
}

class DatTriggers {
 public:
  std::optional<Trigger> take(uint64_t record) {
    return Trigger{clock_.unwrap(static_cast<uint32_t>(record)), static_cast<uint16_t>(record >> 40 & 0x1F),
                   static_cast<uint8_t>(record >> 32 & 1)};
  }

 private:
  dat::Clock clock_;
};

Result<std::unique_ptr<TriggerSource>> open_dat_triggers(Input input, const ReadOptions& options) {
  const auto type = take_type(input);
  if (!type) return type.error();
  if (*type != dat::kTrigger) {
    return Error{ErrorCode::unrecognised, "the DAT file holds no triggers, records of type 14"};
  }
  return make_decoded_triggers(std::move(input), options,
                               TriggersByWord<uint64_t, DatTriggers>(DatTriggers()));
}

}  // namespace

const Format kDatFormat = {.name = kName,
                           .title = "Prophesee DAT",
                           .prophesee = true,
                           .open = open_dat,
                           .create = create_dat,
                           .open_triggers = open_dat_triggers,
                           .writes_header = true};

}  // namespace scarf
