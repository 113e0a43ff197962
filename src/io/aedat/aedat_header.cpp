#include "io/aedat/aedat_header.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace scarf {
namespace {

constexpr size_t kMaxLine = size_t{64} << 10;
static_assert(kMaxLine < ByteReader::kCapacity);

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < ' ' && c != '\t';
}

std::string_view without_spaces(std::string_view word) {
  const size_t begin = word.find_first_not_of(" \t");
  return begin == word.npos ? std::string_view()
                            : word.substr(begin, word.find_last_not_of(" \t") + 1 - begin);
}

// A line at the front of the input.
struct Line {
  std::string_view text;
  size_t bytes = 0;  // with its end; 0: the input ends within the line
};

// nullopt: what is at the front of the input is no line of a header.
Result<std::optional<Line>> line_at_front(ByteReader& input) {
  if (const auto filled = input.fill(1); !filled) return filled.error();
  for (size_t looked_at = 0;;) {
    const auto bytes = input.available();
    const std::string_view front(reinterpret_cast<const char*>(bytes.data()),
                                 std::min(bytes.size(), kMaxLine));
    if (front.empty() || front[0] != '#') return std::optional<Line>();
    const size_t end = front.find('\n', looked_at);
    std::string_view text = front.substr(0, end);
    // The return in front of the end; it may be the last byte that is there so far.
    if (text.ends_with('\r')) text.remove_suffix(1);
    if (std::any_of(text.begin(), text.end(), is_control)) return std::optional<Line>();
    if (end != front.npos) return std::optional(Line{text, end + 1});
    if (front.size() == kMaxLine) return std::optional<Line>();
    if (input.ended()) return std::optional(Line{text, 0});
    looked_at = front.size();
    if (const auto refilled = input.refill(); !refilled) return refilled.error();
  }
}

}  // namespace

Result<void> take_aedat_lines(ByteReader& input, const std::function<bool(std::string_view)>& use) {
  for (;;) {
    const auto line = line_at_front(input);
    if (!line) return line.error();
    if (!*line) return {};
    if ((*line)->bytes == 0) return Error{ErrorCode::bad_input, "the file ends within its header"};
    const bool last = use((*line)->text.substr(1));
    input.skip((*line)->bytes);
    if (last) return {};
  }
}

std::string_view aedat_value(std::string_view line, std::string_view key) {
  line = without_spaces(line);
  if (!line.starts_with(key)) return {};
  line = without_spaces(line.substr(key.size()));
  return line.starts_with(':') ? without_spaces(line.substr(1)) : std::string_view();
}

}  // namespace scarf
