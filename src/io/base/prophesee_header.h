// The text header of Prophesee RAW and DAT files: lines `% key value`.
// Source: Prophesee, "RAW File Format".
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_reader.h"
#include "scarf/core/event.h"
#include "scarf/io/recordings.h"

namespace scarf {

namespace evt21 {
/// How a word lies in the file.
enum class ByteOrder {
  little,  ///< as a little-endian number of 64 bits
  legacy,  ///< as two little-endian numbers of 32 bits, the upper half first
};
}  // namespace evt21

struct PropheseeHeader {
  std::string_view format;  ///< a name of formats(); empty if the header does not say
  std::optional<SensorSize> sensor;
  evt21::ByteOrder byte_order = evt21::ByteOrder::little;  ///< of EVT2.1, as said or as the camera implies
  std::optional<int64_t> dat_version;
  std::vector<HeaderLine> camera;  ///< the lines that say none of the above
};

/// Reads the header and leaves `input` at the first word behind it; nullopt, and nothing skipped, if there is
/// none. Errors: io; bad_input, if it names another format, an illegal size or two different sizes, or has no
/// end.
Result<std::optional<PropheseeHeader>> read_prophesee_header(ByteReader& input);

/// A header that names both, and holds the lines of `camera`. `format`: one of the word formats, or "dat".
std::string prophesee_header_text(std::string_view format, SensorSize sensor,
                                  std::span<const HeaderLine> camera);

/// Whether the line can be one of PropheseeHeader::camera, and be read again.
bool is_camera_line(const HeaderLine& line);

}  // namespace scarf
