// Division that rounds up.
#pragma once

#include <type_traits>

namespace scarf {

/// The smallest whole number that is not below a / b, for a >= 0 and b > 0.
template <class T>
constexpr T ceil_div(T a, std::type_identity_t<T> b) {
  return (a + b - 1) / b;
}

}  // namespace scarf
