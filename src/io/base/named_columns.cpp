#include "io/base/named_columns.h"

#include <algorithm>
#include <charconv>

#include "core/text.h"

namespace scarf {
namespace {

constexpr std::string_view kFields = "txyp";

// A name, perhaps with a number in brackets behind it.
NamedColumn column_from(std::string_view word) {
  const size_t bracket = word.rfind('[');
  if (bracket == word.npos || !word.ends_with(']')) return {std::string(word)};
  size_t index = 0;
  const char* const begin = word.data() + bracket + 1;
  const char* const last = word.data() + word.size() - 1;
  const auto [end, failure] = std::from_chars(begin, last, index);
  if (failure != std::errc() || end != last) return {std::string(word)};
  return {std::string(word.substr(0, bracket)), index};
}

}  // namespace

Result<NamedColumns> named_columns_from(std::string_view columns) {
  NamedColumns named;
  std::array<bool, 4> given{};
  bool legal = true;
  for (std::string_view rest = columns; legal;) {
    const std::string_view one = rest.substr(0, rest.find(','));
    const size_t field = one.size() > 2 && one[1] == '=' ? kFields.find(one[0]) : kFields.npos;
    legal = field != kFields.npos && !given[field];
    if (legal) {
      given[field] = true;
      named[field] = column_from(one.substr(2));
    }
    if (one.size() == rest.size()) break;
    rest.remove_prefix(one.size() + 1);
  }
  if (legal && std::all_of(given.begin(), given.end(), [](bool g) { return g; })) return named;
  return Error{ErrorCode::illegal_parameter,
               text("the columns '", columns,
                    "' must name each of t, x, y and p once, such as t=/a/ts,x=/a/xs,y=/a/ys,p=/a/pol, or "
                    "t=ev[0],x=ev[1],y=ev[2],p=ev[3]")};
}

}  // namespace scarf
