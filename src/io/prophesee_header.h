// The text header of Prophesee RAW files: lines `% key value`.
// Source: Prophesee, "RAW File Format".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/byte_reader.h"
#include "scarf/event.h"

namespace scarf {

struct PropheseeHeader {
  std::string_view format;  ///< a name of formats(); empty if the header does not say
  std::optional<SensorSize> sensor;
};

/// Reads the header and leaves `input` at the first word behind it; nullopt, and nothing skipped, if there is
/// none. Errors: io; bad_input, if it names another format, an illegal size or two different sizes, or has no
/// end.
Result<std::optional<PropheseeHeader>> read_prophesee_header(ByteReader& input);

/// A header that names both.
std::string prophesee_header_text(std::string_view format, SensorSize sensor);

}  // namespace scarf
