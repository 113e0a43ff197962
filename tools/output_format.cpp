#include "tools/output_format.h"

#include <filesystem>
#include <string_view>

#include "core/text.h"

namespace scarf::tools {
namespace {

struct Extension {
  std::string_view extension;
  std::string_view format;
};

constexpr Extension kExtensions[] = {
    {".raw", "evt3"},  {".dat", "dat"}, {".txt", "text"}, {".h5", "dsec"},
    {".hdf5", "dsec"}, {".csv", "csv"}, {".es", "es"},    {".npy", "npy"},
};

}  // namespace

Result<std::string> output_format(const std::string& path, const std::string& given) {
  if (!given.empty()) return given;
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const Extension& e : kExtensions) {
    if (e.extension == extension) return std::string(e.format);
  }
  return Error{
      ErrorCode::illegal_parameter,
      text("the format of ", path, " does not follow from its name; add --output-format, or end the name in ",
           output_extensions())};
}

std::string output_extensions() {
  std::string list;
  for (const Extension& e : kExtensions) list += text(list.empty() ? "" : ", ", e.extension, " ", e.format);
  return list;
}

}  // namespace scarf::tools
