#include "tools/event_list_writer.h"

#include <filesystem>

#include "core/text.h"
#include "tools/hdf5_writer.h"
#include "tools/npz_events_writer.h"

namespace scarf::tools {

Result<std::unique_ptr<EventListWriter>> make_event_list_writer(const std::string& path, SensorSize sensor) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".h5" || extension == ".hdf5") return create_hdf5_events(path, sensor);
  if (extension == ".npz") return create_npz_events(path);
  return Error{ErrorCode::illegal_parameter,
               text("sparse events cannot be written as ", path, "; use a name that ends in .h5 or .npz")};
}

}  // namespace scarf::tools
