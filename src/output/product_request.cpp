#include "output/product_request.h"

#include "scarf/core/encoding.h"

namespace scarf {
namespace {

std::string encoding_names() {
  std::string names;
  for (const EncodingInfo& info : encodings()) names += (names.empty() ? "" : ", ") + info.name;
  return names;
}

}  // namespace

Settings product_settings(ProductRequest& request, const std::string& sparse_help) {
  const std::string what = "What";
  Settings settings("ProductRequest");
  settings
      .add_choice<bool>("pixels", request.floats, {{"u8", false}, {"float", true}},
                        "Default u8; float is offered for .npy and .h5", "floats")
      .in(what);
  settings
      .add_text(Setting::Kind::word, "encoding", request.encoding,
                "A tensor of the active events instead of a picture, into an .h5: one of " +
                    encoding_names() + ", such as voxel_grid:bins=5")
      .in(what);
  settings.add_text(Setting::Kind::output, "sparse", request.sparse, sparse_help).in(what);
  return settings;
}

}  // namespace scarf
