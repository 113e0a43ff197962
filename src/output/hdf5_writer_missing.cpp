// Stands for hdf5_writer.cpp in a build without HDF5.
#include "output/hdf5_writer.h"

namespace scarf {
namespace {

Error missing() {
  return {
      ErrorCode::illegal_parameter,
      "this build of scarf writes no HDF5; install libhdf5-dev and build again, or choose another output"};
}

}  // namespace

Result<std::unique_ptr<Hdf5ArrayWriter>> create_hdf5_arrays(const std::string&, std::string_view, Hdf5Element,
                                                            std::vector<size_t>, const OutputRule&) {
  return missing();
}

Result<std::unique_ptr<EventListWriter>> create_hdf5_events(const std::string&, SensorSize,
                                                            const OutputRule&) {
  return missing();
}

}  // namespace scarf
