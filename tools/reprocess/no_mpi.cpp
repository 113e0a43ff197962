#include "tools/reprocess/mpi_crew.h"

namespace scarf::tools::reprocess {

Result<std::unique_ptr<MpiSession>> MpiSession::start() {
  return std::unique_ptr<MpiSession>();
}

}  // namespace scarf::tools::reprocess
