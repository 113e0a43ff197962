// What is made of each frame: shared by the command line and recipes.
#pragma once

#include <string>

#include "session/settings.h"

namespace scarf {

struct ProductRequest {
  bool floats = false;   ///< the pixels of arrays
  std::string encoding;  ///< words, see parse_encoding: tensors instead of pictures; empty: pictures
  std::string sparse;    ///< where the sparse events of each frame go; empty: nowhere

  /// Whether anything but 8-bit pictures is asked for.
  bool special() const { return floats || !encoding.empty() || !sparse.empty(); }
};

/// The settings by which words fill in the request, which outlives them. `sparse_help`: what "sparse" names.
Settings product_settings(ProductRequest& request, const std::string& sparse_help);

}  // namespace scarf
