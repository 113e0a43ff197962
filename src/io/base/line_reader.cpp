#include "io/base/line_reader.h"

#include <algorithm>
#include <utility>

#include "core/text.h"

namespace scarf {

LineReader::LineReader(ByteReader bytes, size_t max_line) : bytes_(std::move(bytes)), max_line_(max_line) {}

Result<LineReader> LineReader::open(const std::string& path, size_t max_line) {
  auto bytes = ByteReader::open_regular(path);
  if (!bytes) return bytes.error();
  return LineReader(*std::move(bytes), max_line);
}

Result<std::optional<std::string_view>> LineReader::next() {
  bytes_.skip(std::exchange(taken_, 0));
  constexpr size_t kEnd = 2;  // \r\n
  if (const auto filled = bytes_.fill(max_line_ + kEnd); !filled) return filled.error();
  const auto bytes = bytes_.available();
  if (bytes.empty()) return std::optional<std::string_view>();
  ++number_;
  std::string_view line(reinterpret_cast<const char*>(bytes.data()),
                        std::min(bytes.size(), max_line_ + kEnd));
  const size_t newline = line.find('\n');
  taken_ = newline == line.npos ? line.size() : newline + 1;
  line = line.substr(0, newline);
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line.size() > max_line_) {
    return Error{ErrorCode::bad_input, text("line ", number_, " has more than ", max_line_, " characters")};
  }
  return std::optional(line);
}

}  // namespace scarf
