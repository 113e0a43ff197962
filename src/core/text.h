// Text from pieces, for error messages; numbers are written the same in every locale.
#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace scarf {

template <class... Pieces>
std::string text(const Pieces&... pieces) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // without memory: an exception, not a text that ends early
  out.imbue(std::locale::classic());
  (out << ... << pieces);
  return out.str();
}

}  // namespace scarf
