// Stands for npz_events_writer.cpp in a build without libzip.
#include "output/npz_events_writer.h"

namespace scarf {

Result<std::unique_ptr<EventListWriter>> create_npz_events(const std::string&, const OutputRule&) {
  return Error{ErrorCode::illegal_parameter,
               "this build of scarf writes no .npz; install libzip-dev and build again, or choose .h5"};
}

}  // namespace scarf
