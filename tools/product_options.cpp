#include "tools/product_options.h"

#include "scarf/encoding.h"
#include "tools/file_options.h"

namespace scarf::tools {
namespace {

std::string encoding_names() {
  std::string names;
  for (const EncodingInfo& info : encodings()) names += (names.empty() ? "" : ", ") + info.name;
  return names;
}

}  // namespace

void add_product_options(CLI::App& app, ProductOptions& options, const std::string& sparse_help) {
  const std::string what = "What";
  app.add_option_function<std::string>(
         "--pixels", [&options](const std::string& word) { options.floats = word == "float"; },
         "u8 or float, default u8; float is offered for .npy and .h5")
      ->check(CLI::IsMember({"u8", "float"}))
      ->group(what);
  add_word_option(app, "--encoding", options.encoding,
                  "A tensor of the active events instead of a picture, into an .h5: one of " +
                      encoding_names() + ", such as voxel_grid:bins=5")
      ->group(what);
  add_output_option(app, "--sparse", options.sparse, sparse_help)->group(what);
}

}  // namespace scarf::tools
