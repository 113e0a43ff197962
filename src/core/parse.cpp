#include "core/parse.h"

#include <cmath>

#include "core/fields.h"
#include "core/text.h"
#include "scarf/core/patch_grid.h"

namespace scarf {
namespace {

Result<Pair> parse_pair(const std::string& word, char separator, std::string_view form) {
  const std::string_view view = word;
  const size_t middle = view.find(separator);
  if (middle != std::string_view::npos) {
    const auto x = parse_integer<int32_t>(view.substr(0, middle));
    const auto y = parse_integer<int32_t>(view.substr(middle + 1));
    if (x && y) return Pair{*x, *y};
  }
  return Error{ErrorCode::illegal_parameter, text("'", word, "' is not of the form ", form)};
}

}  // namespace

Result<double> parse_number(const std::string& word) {
  const auto value = parse_integer<double>(word);
  if (value && std::isfinite(*value)) return *value;
  return Error{ErrorCode::illegal_parameter, text("'", word, "' is not a finite decimal number")};
}

Result<uint64_t> parse_positive(const std::string& word) {
  const auto value = parse_integer<uint64_t>(word);
  if (value && *value > 0) return *value;
  return Error{ErrorCode::illegal_parameter,
               text("'", word, "' is not a whole number from 1 to ", std::numeric_limits<uint64_t>::max())};
}

Result<int64_t> parse_time(const std::string& word) {
  const bool negative = word.starts_with('-');
  int64_t time = 0;
  if (read_word(negative ? word.substr(1) : word, time)) return negative ? -time : time;
  return Error{
      ErrorCode::illegal_parameter,
      text("'", word, "' is not a time of whole microseconds, such as 1500000, 1.5s, 20ms or 300us")};
}

Result<Pair> parse_by(const std::string& word) {
  return parse_pair(word, 'x', "WxH, such as 18x18");
}

Result<Pair> parse_comma(const std::string& word) {
  return parse_pair(word, ',', "X,Y, such as 9,9");
}

Result<SensorSize> parse_sensor(const std::string& word) {
  const auto pair = parse_pair(word, 'x', "WxH, such as 640x480");
  if (!pair) return pair.error();
  if (pair->x < 1 || pair->x > kMaxSensorSize || pair->y < 1 || pair->y > kMaxSensorSize) {
    return Error{ErrorCode::illegal_parameter,
                 text("sensor size is ", word, ", legal is 1x1 to ", kMaxSensorSize, "x", kMaxSensorSize)};
  }
  return SensorSize{pair->x, pair->y};
}

}  // namespace scarf
