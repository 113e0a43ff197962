#include "tools/output_format.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "core/text.h"

namespace scarf::tools {
namespace {

struct Extension {
  std::string_view extension;
  std::string_view format;
};

constexpr std::string_view kRaw = ".raw";
constexpr std::string_view kRawFormats[] = {"evt2", "evt21", "evt3", "evt4"};

constexpr Extension kExtensions[] = {
    {kRaw, "evt3"},    {".dat", "dat"}, {".txt", "text"}, {".h5", "dsec"},
    {".hdf5", "dsec"}, {".csv", "csv"}, {".es", "es"},    {".npy", "npy"},
};

}  // namespace

Result<std::string> output_format(const std::string& path, const std::string& given,
                                  std::string_view original) {
  if (!given.empty()) return given;
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const Extension& e : kExtensions) {
    if (e.extension != extension) continue;
    const bool same = extension == kRaw && std::find(std::begin(kRawFormats), std::end(kRawFormats),
                                                     original) != std::end(kRawFormats);
    return std::string(same ? original : e.format);
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
