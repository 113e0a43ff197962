#include "output/event_list_writer.h"

#include <filesystem>

#include "core/text.h"
#include "output/hdf5_writer.h"
#include "output/npz_events_writer.h"

namespace scarf {
namespace {

std::string extension_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

bool is_hdf5(const std::string& path) {
  return extension_of(path) == ".h5" || extension_of(path) == ".hdf5";
}

}  // namespace

Result<void> check_event_list(const std::string& path) {
  if (is_hdf5(path) || extension_of(path) == ".npz") return {};
  return Error{ErrorCode::illegal_parameter,
               text("sparse events cannot be written as ", path, "; use a name that ends in .h5 or .npz")};
}

Result<std::unique_ptr<EventListWriter>> make_event_list_writer(const std::string& path, SensorSize sensor,
                                                                const OutputRule& rule) {
  if (auto r = check_event_list(path); !r) return r.error();
  return is_hdf5(path) ? create_hdf5_events(path, sensor, rule) : create_npz_events(path, rule);
}

}  // namespace scarf
