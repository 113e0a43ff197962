#include "reprocess/mpi_crew.h"

namespace scarf::reprocess {

Result<std::unique_ptr<MpiSession>> MpiSession::start() {
  return std::unique_ptr<MpiSession>();
}

}  // namespace scarf::reprocess
