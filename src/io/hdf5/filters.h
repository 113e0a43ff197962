// The filters that compress chunks.
#pragma once

#include "io/hdf5/library.h"
#include "scarf/core/result.h"

namespace scarf::hdf5 {

/// Whether the only filter of a dataset with these creation properties is ECF, which scarf decodes itself.
bool only_ecf(const Handle& creation);

/// Errors: bad_input, naming the first filter that is not installed, and its Debian package.
Result<void> check_filters(const Handle& creation, const std::string& path);

}  // namespace scarf::hdf5
