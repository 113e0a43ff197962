// The choice among several cameras of one recording.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scarf/core/result.h"

namespace scarf {

struct StreamName {
  std::string name;   ///< as --stream takes it
  std::string about;  ///< for people: sensor, source
};

/// The number of the stream that is meant: the one called `wanted`, or the only one. `what`: "event streams".
/// Errors: bad_input if there is none or, without `wanted`, several; illegal_parameter if none is called so;
/// they list what is there.
Result<size_t> choose_stream(const std::string& wanted, std::span<const StreamName> streams,
                             std::string_view what);

}  // namespace scarf
