// The header of AEDAT 1 to 3: lines that begin with #, and the line that names the version.
// Sources: iniVation, "AEDAT File Formats"; SensorsINI/jaer, which writes the files.
#pragma once

#include <functional>
#include <string_view>

#include "io/base/byte_reader.h"
#include "scarf/core/result.h"

namespace scarf {

/// Takes the header's lines off the input and hands each to `use`, without # and the end of the line, until
/// `use` returns true, which the last line of a header that says where it ends does, or something else
/// follows. A record may begin with the byte #, too: a line with control characters in it, or of more than
/// 64 KiB, is none of the header's. Errors: io; bad_input if the input ends within a line.
Result<void> take_aedat_lines(ByteReader& input, const std::function<bool(std::string_view line)>& use);

/// What stands behind `key` and a colon in a line, without spaces around it; empty if the line has no such
/// key.
std::string_view aedat_value(std::string_view line, std::string_view key);

}  // namespace scarf
