// Options that say what is made of each frame: shared by scarf render and recipes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace scarf::tools {

struct ProductOptions {
  bool floats = false;   ///< the pixels of arrays
  std::string encoding;  ///< words, see parse_encoding: tensors instead of pictures; empty: pictures
  std::string sparse;    ///< where the sparse events of each frame go; empty: nowhere

  /// Whether anything but 8-bit pictures is asked for.
  bool special() const { return floats || !encoding.empty() || !sparse.empty(); }
};

/// `sparse_help`: what --sparse names.
void add_product_options(CLI::App& app, ProductOptions& options, const std::string& sparse_help);

}  // namespace scarf::tools
