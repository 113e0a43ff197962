// Text from pieces, for error messages; numbers are written the same in every locale.
#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace scarf {

template <class... Pieces>
std::string text(const Pieces&... pieces) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  (out << ... << pieces);
  return out.str();
}

}  // namespace scarf
