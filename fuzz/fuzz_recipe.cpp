// Recipes and lists of reprocess: any bytes give settings or an error of one line.
#include <string>

#include "fuzz_reader.h"
#include "input_folder.h"
#include "tools/reprocess/manifest.h"
#include "tools/reprocess/recipe.h"

namespace scarf::tools::reprocess {

// What the words of a setting mean takes the whole program; here they all stand.
Result<std::unique_ptr<Options>> parse_settings(const Settings&) {
  return std::make_unique<Options>();
}
void lay_over(Settings& settings, const Settings& more) {
  for (const auto& [name, words] : more) settings[name] = words;
}

}  // namespace scarf::tools::reprocess

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scarf;
  static const InputFolder folder;
  const std::string content(reinterpret_cast<const char*>(data), size);
  const auto recipe = tools::reprocess::parse_recipe(content, "recipe.toml");
  if (recipe) {
    recipe->for_recording("a/recording.raw");
  } else {
    require(!recipe.error().message.empty());
  }
  const auto listed = tools::reprocess::read_manifest(folder.put("list", {data, size}));
  if (!listed) return 0;
  for (const auto& entry : *listed) require(!entry.path.empty() && entry.path != "-" && entry.line > 0);
  return 0;
}
