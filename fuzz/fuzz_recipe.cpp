// Recipes and lists of reprocess: any bytes give settings or an error of one line.
#include <string>

#include "fuzz/fuzz_reader.h"
#include "fuzz/input_folder.h"
#include "reprocess/manifest.h"
#include "reprocess/recipe.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scarf;
  static const InputFolder folder;
  const std::string content(reinterpret_cast<const char*>(data), size);
  const auto recipe = reprocess::parse_recipe(content, "recipe.toml");
  if (recipe) {
    recipe->for_recording("a/recording.raw");
  } else {
    require(!recipe.error().message.empty());
  }
  const auto listed = reprocess::read_manifest(folder.put("list", {data, size}));
  if (!listed) return 0;
  for (const auto& entry : *listed) require(!entry.path.empty() && entry.path != "-" && entry.line > 0);
  return 0;
}
