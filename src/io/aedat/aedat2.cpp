#include "io/aedat/aedat2.h"

#include <string_view>
#include <utility>

#include "core/text.h"
#include "io/aedat/aedat_header.h"
#include "io/base/sensor_size.h"

namespace scarf::aedat2 {
namespace {

constexpr Layout kDavis = {.x_shift = 12,
                           .x_mask = 0x3FF,
                           .y_shift = 22,
                           .y_mask = 0x1FF,
                           .p_shift = 11,
                           .samples = uint32_t{1} << 31,
                           .triggers = uint32_t{1} << 10,
                           .falling = 2};
// Bit 15 is the sync input, bit 31 any special record of jAER. The polarity bit is inverted in the hardware.
constexpr Layout kDvs128 = {.x_shift = 1,
                            .x_mask = 0x7F,
                            .y_shift = 8,
                            .y_mask = 0x7F,
                            .p_shift = 0,
                            .on = 0,
                            .samples = uint32_t{1} << 31,
                            .triggers = uint32_t{1} << 15,
                            .undefined = 0x7FFF0000};
// What v2e writes for 640x480, and jAER's DVS640 reads.
constexpr Layout kDvs640 = {.x_shift = 1,
                            .x_mask = 0x3FF,
                            .y_shift = 11,
                            .y_mask = 0x3FF,
                            .p_shift = 0,
                            .samples = uint32_t{1} << 31,
                            .undefined = 0x7FE00000};

constexpr Chip kDvs128Chip = {kDvs128, {128, 128}};
constexpr Chip kDvs640Chip = {kDvs640, {640, 480}};

struct DavisSize {
  std::string_view word;  // in the name of a DAVIS
  SensorSize sensor;
};
constexpr DavisSize kDavisSizes[] = {{"128", {128, 128}},
                                     {"240", {240, 180}},
                                     {"SBRET", {240, 180}},
                                     {"346", {346, 260}},
                                     {"640", {640, 480}}};

struct Header {
  std::string chip;             // the class of jAER, without its packages, in capitals
  bool labelled_noise = false;  // v2e marks simulated noise as triggers: events nevertheless
};

std::string capitals(std::string_view word) {
  std::string upper(word);
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return upper;
}

Result<Header> take_header(ByteReader& input) {
  Header header;
  const auto taken = take_aedat_lines(input, [&](std::string_view line) {
    if (const auto chip = aedat_value(line, "AEChip"); !chip.empty()) {
      header.chip = capitals(chip.substr(chip.find_last_of('.') + 1));
    }
    header.labelled_noise |= line.find("noise events are labeled") != line.npos;
    return line.find("End Of ASCII Header") != line.npos;
  });
  if (!taken) return taken.error();
  return header;
}

// The chip that the header names; without a size if that is not known.
std::optional<std::pair<Layout, std::optional<SensorSize>>> chip_named(std::string_view name) {
  const auto has = [name](std::string_view word) { return name.find(word) != name.npos; };
  if (has("STEREO")) return std::nullopt;  // two cameras share the addresses
  if (has("DVS128") || has("TMPDIFF128")) return std::pair{kDvs128, std::optional(kDvs128Chip.sensor)};
  if (name == "DVS640") return std::pair{kDvs640, std::optional(kDvs640Chip.sensor)};
  if (!has("DAVIS") && !has("SBRET")) return std::nullopt;
  for (const DavisSize& size : kDavisSizes) {
    if (has(size.word)) return std::pair{kDavis, std::optional(size.sensor)};
  }
  return std::pair{kDavis, std::optional<SensorSize>()};
}

// The chip that a sensor size stands for, where the header names none.
std::optional<Chip> chip_of(SensorSize sensor) {
  if (sensor == kDvs128Chip.sensor) return kDvs128Chip;
  if (sensor == kDvs640Chip.sensor) return kDvs640Chip;
  if (sensor == SensorSize{240, 180} || sensor == SensorSize{346, 260}) return Chip{kDavis, sensor};
  return std::nullopt;
}

Error unknown_chip(const Header& header) {
  const std::string what = header.chip.empty() ? "the header names no chip (AEChip)"
                                               : text("the header names the chip ", header.chip.substr(0, 60),
                                                      ", which scarf does not know");
  return {
      ErrorCode::bad_input,
      text(what,
           "; say with ReadOptions::sensor how the addresses are to be read: 128x128 as those of a DVS128, "
           "240x180 or 346x260 as those of a DAVIS, 640x480 as v2e writes them")};
}

}  // namespace

Result<Chip> read_header(ByteReader& input, std::optional<SensorSize> sensor) {
  const auto header = take_header(input);
  if (!header) return header.error();
  std::optional<Chip> chip;
  if (const auto named = chip_named(header->chip)) {
    const auto agreed = agreed_sensor(named->second, sensor);
    if (!agreed) return agreed.error();
    if (!*agreed) {
      return Error{ErrorCode::bad_input,
                   text("the header names the chip ", header->chip.substr(0, 60),
                        ", whose size scarf does not know; give it with ReadOptions::sensor WxH")};
    }
    chip = Chip{named->first, **agreed};
  } else if (sensor) {
    chip = chip_of(*sensor);
  }
  if (!chip) return unknown_chip(*header);
  if (header->labelled_noise) chip->layout.triggers = 0;
  return *chip;
}

Result<Chip> read_header_of_version_1(ByteReader& input, std::optional<SensorSize> sensor) {
  const auto header = take_header(input);
  if (!header) return header.error();
  const auto named = chip_named(header->chip);
  if (!header->chip.empty() && (!named || named->second != kDvs128Chip.sensor)) {
    return Error{ErrorCode::bad_input, text("the header names the chip ", header->chip.substr(0, 60),
                                            "; of AEDAT 1 scarf reads that of the DVS128")};
  }
  const auto agreed = agreed_sensor(kDvs128Chip.sensor, sensor);
  if (!agreed) return agreed.error();
  return kDvs128Chip;
}

}  // namespace scarf::aedat2
