// The HDF5 formats; built also without libhdf5, to say what is missing.
#include <string_view>

#include "io/base/known_formats.h"
#include "io/base/writers.h"
#include "io/hdf5/family.h"
#include "io/hdf5/reader.h"

namespace scarf {
namespace {

using hdf5::Family;

// The superblock stands at byte 0, 512, 1024, 2048 and so on, behind whatever its user has put there.
bool is_hdf5(const Beginning& beginning) {
  constexpr std::string_view kMagic("\x89HDF\r\n\x1a\n", 8);
  const std::string_view bytes(reinterpret_cast<const char*>(beginning.bytes.data()), beginning.bytes.size());
  for (size_t at = 0; at < bytes.size(); at = at == 0 ? 512 : 2 * at) {
    if (bytes.substr(at).starts_with(kMagic)) return true;
  }
  return false;
}

template <Family family>
constexpr Format hdf5_format(std::string_view title, uint32_t options = 0) {
  Format format{.name = hdf5::name_of(family), .title = title, .options = options};
  // Recognises what is HDF5 and in no layout known, so that the error can say so.
  if constexpr (family == Family::other) format.recognise = is_hdf5;
  if constexpr (SCARF_HDF5) {
    if constexpr (family != Family::other) {
      format.recognise = [](const Beginning& beginning) {
        return is_hdf5(beginning) && !beginning.path.empty() && hdf5::recognise(beginning.path, family);
      };
    }
    format.open = [](Input input, const ReadOptions& read_options) {
      return hdf5::open(std::move(input), read_options, family);
    };
    if constexpr (family == Family::mvsec) format.open_frames = hdf5::open_mvsec_frames;
    if constexpr (family == Family::dsec) format.create = create_dsec;
  } else {
    format.missing = "HDF5 (libhdf5-dev)";
  }
  return format;
}

}  // namespace

const Format kMetavisionHdf5Format = hdf5_format<Family::metavision>("Metavision HDF5, ECF or not");
const Format kMvsecFormat = hdf5_format<Family::mvsec>("MVSEC HDF5", kTakesStream);
const Format kM3edFormat = hdf5_format<Family::m3ed>("M3ED HDF5", kTakesStream);
const Format kDsecFormat = hdf5_format<Family::dsec>("DSEC HDF5");
const Format kRvtFormat = hdf5_format<Family::rvt>("HDF5 of RVT and the 1 Mpx data set");
const Format kEventUtilsFormat = hdf5_format<Family::event_utils>("HDF5 of event_utils");
// Without libhdf5 it stands for all of them.
const Format kHdf5Format =
    hdf5_format<Family::other>(SCARF_HDF5 ? "other HDF5: columns, records or an array" : "HDF5",
                               kTakesColumns | kTakesTimeUnit | kTakesStream);

}  // namespace scarf
