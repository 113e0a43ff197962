#include "io/numpy/numpy_header.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/format.h"

namespace scarf {
namespace {

constexpr size_t kMaxHeader = 64 * 1024;
constexpr size_t kMaxItem = 64 * 1024;
constexpr int kMaxDepth = 8;  // of fields within fields

Error bad(std::string_view what) {
  return {ErrorCode::bad_input, text("the array's header ", what)};
}

std::optional<uint64_t> number_from(std::string_view digits) {
  uint64_t value = 0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (failure != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

// "<u2", "|b1", "<m8[us]", "|O", "|V4".
std::optional<NumpyType> type_from(std::string_view code) {
  NumpyType type;
  if (!code.empty() && std::string_view("<>|=").find(code[0]) != std::string_view::npos) {
    type.big_endian = code[0] == '>';
    code.remove_prefix(1);
  }
  if (code.empty()) return std::nullopt;
  type.kind = code[0];
  code.remove_prefix(1);
  const size_t bracket = std::min(code.find('['), code.size());
  if (bracket < code.size()) {
    if (!code.ends_with(']')) return std::nullopt;
    type.unit = code.substr(bracket + 1, code.size() - bracket - 2);
  }
  if (bracket == 0) {
    type.bytes = type.kind == 'O' ? 8 : 0;
    return type.kind == 'O' ? std::optional(type) : std::nullopt;
  }
  const auto bytes = number_from(code.substr(0, bracket));
  if (!bytes || *bytes > kMaxItem) return std::nullopt;
  type.bytes = static_cast<size_t>(*bytes) * (type.kind == 'U' ? 4 : 1);
  return type;
}

// The dictionary of the header: Python's literals, as far as it has them.
class Dictionary {
 public:
  explicit Dictionary(std::string_view rest) : rest_(rest) {}

  // nullopt if it is not such a dictionary.
  std::optional<NumpyHeader> parse() {
    bool has_type = false;
    bool has_order = false;
    bool has_shape = false;
    if (!take('{')) return std::nullopt;
    while (!take('}')) {
      const auto key = take_string();
      if (!key || !take(':')) return std::nullopt;
      if (*key == "descr") {
        has_type = take_type();
        if (!has_type) return std::nullopt;
      } else if (*key == "fortran_order") {
        header_.fortran_order = take_word("True");
        has_order = header_.fortran_order || take_word("False");
      } else if (*key == "shape") {
        const auto shape = take_shape();
        if (!shape) return std::nullopt;
        header_.shape = *shape;
        has_shape = true;
      } else {
        return std::nullopt;
      }
      if (!take(',') && !sees('}')) return std::nullopt;
    }
    if (!has_type || !has_order || !has_shape) return std::nullopt;
    return header_;
  }

 private:
  void skip_spaces() {
    const size_t at = rest_.find_first_not_of(" \t\n");
    rest_.remove_prefix(std::min(at, rest_.size()));
  }

  bool sees(char c) {
    skip_spaces();
    return rest_.starts_with(c);
  }

  bool take(char c) {
    const bool seen = sees(c);
    if (seen) rest_.remove_prefix(1);
    return seen;
  }

  bool take_word(std::string_view word) {
    skip_spaces();
    const bool seen = rest_.starts_with(word);
    if (seen) rest_.remove_prefix(word.size());
    return seen;
  }

  std::optional<std::string_view> take_string() {
    for (const char quote : {'\'', '"'}) {
      if (!take(quote)) continue;
      const size_t end = rest_.find(quote);
      if (end == rest_.npos) return std::nullopt;
      const auto content = rest_.substr(0, end);
      rest_.remove_prefix(end + 1);
      return content;
    }
    return std::nullopt;
  }

  std::optional<std::vector<uint64_t>> take_shape() {
    std::vector<uint64_t> shape;
    if (!take('(')) return std::nullopt;
    while (!take(')')) {
      skip_spaces();
      const size_t length = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
      const auto value = number_from(rest_.substr(0, length));
      rest_.remove_prefix(length);
      take('L');
      if (!value || (!take(',') && !sees(')'))) return std::nullopt;
      shape.push_back(*value);
    }
    return shape;
  }

  // A type, or a list of fields.
  bool take_type() {
    if (sees('[')) {
      header_.named = true;
      return take_fields(0, true);
    }
    const auto code = take_string();
    const auto type = code ? type_from(*code) : std::nullopt;
    return type && add({"", *type});
  }

  bool add(NumpyField field) {
    if (field.count > kMaxItem || field.type.bytes * field.count > kMaxItem - header_.item_bytes)
      return false;
    field.offset = header_.item_bytes;
    header_.item_bytes += field.type.bytes * field.count;
    header_.fields.push_back(std::move(field));
    return true;
  }

  // Fields within fields are passed over: `keep` is false for them.
  bool take_fields(int depth, bool keep) {
    if (depth > kMaxDepth || !take('[')) return false;
    while (!take(']')) {
      if (!take_field(depth, keep)) return false;
      if (!take(',') && !sees(']')) return false;
    }
    return true;
  }

  // (name, type), (name, type, shape); a name may be (title, name).
  bool take_field(int depth, bool keep) {
    if (!take('(')) return false;
    std::optional<std::string_view> name;
    if (take('(')) {
      if (!take_string() || !take(',')) return false;
      name = take_string();
      if (!take(')')) return false;
    } else {
      name = take_string();
    }
    if (!name || !take(',')) return false;
    // An array of fields within a field has a size that is not followed here.
    if (sees('[')) return take_fields(depth + 1, false) && take(')');
    const auto code = take_string();
    auto type = code ? type_from(*code) : std::nullopt;
    if (!type) return false;
    NumpyField field{keep ? std::string(*name) : "", *type};
    if (take(',') && sees('(')) {
      const auto shape = take_shape();
      if (!shape) return false;
      for (const uint64_t extent : *shape) {
        if (extent > kMaxItem || field.count > kMaxItem) return false;
        field.count *= static_cast<size_t>(extent);
      }
    }
    return take(')') && add(std::move(field));
  }

  std::string_view rest_;
  NumpyHeader header_;
};

}  // namespace

bool is_number(const NumpyType& type) {
  const bool power = type.bytes == 1 || type.bytes == 2 || type.bytes == 4 || type.bytes == 8;
  switch (type.kind) {
    case 'b':
      return type.bytes == 1;
    case 'i':
    case 'u':
      return power;
    case 'f':
      return power && type.bytes > 1;
    case 'm':
    case 'M':
      return type.bytes == 8;
    default:
      return false;
  }
}

std::string numpy_header_text(std::string_view type, std::string_view shape, size_t size) {
  std::string header(kNumpyMagic);
  const size_t length = size - kNumpyMagic.size() - 4;  // behind the version and the length itself
  header += {'\1', '\0', static_cast<char>(length & 0xFF), static_cast<char>(length >> 8)};
  header += text("{'descr': ", type, ", 'fortran_order': False, 'shape': ", shape, ", }");
  header.resize(size - 1, ' ');
  return header + "\n";
}

Result<NumpyHeader> read_numpy_header(ByteReader& bytes) {
  constexpr size_t kVersionAt = kNumpyMagic.size();
  constexpr size_t kLengthAt = kVersionAt + 2;
  if (const auto filled = bytes.fill(kLengthAt + 4); !filled) return filled.error();
  const auto start = bytes.available();
  if (start.size() < kLengthAt + 4 || !starts_with(start, kNumpyMagic)) return bad("is none of NumPy");
  const uint8_t version = start[kVersionAt];
  if (version < 1 || version > 3) return bad(text("has version ", int{version}, "; scarf reads 1 to 3"));
  const uint8_t* const at = start.data() + kLengthAt;
  const size_t length_bytes = version == 1 ? 2 : 4;
  const size_t length = version == 1 ? load_little_endian<uint16_t>(at) : load_little_endian<uint32_t>(at);
  if (length > kMaxHeader) return bad(text("has ", length, " bytes, more than ", kMaxHeader));
  const size_t begin = kLengthAt + length_bytes;
  if (const auto filled = bytes.fill(begin + length); !filled) return filled.error();
  const auto all = bytes.available();
  if (all.size() < begin + length) return bad("is cut short");
  auto header = Dictionary({reinterpret_cast<const char*>(all.data()) + begin, length}).parse();
  if (!header) return bad("is not understood");
  bytes.skip(begin + length);
  return *std::move(header);
}

}  // namespace scarf
