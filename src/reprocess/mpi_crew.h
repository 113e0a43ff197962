// The ranks of an MPI job as one crew: rank 0 hands out tasks, every rank does them with its threads.
#pragma once

#include <memory>
#include <optional>

#include "reprocess/crew.h"

namespace scarf::reprocess {

/// MPI for as long as it lives. When that of rank 0 ends, the other ranks are dismissed.
class MpiSession {
 public:
  /// nullopt where the program has no MPI or was not started by an MPI launcher with several processes; then
  /// it is one process. Errors: bad_input, if MPI does not start.
  static Result<std::unique_ptr<MpiSession>> start();
  virtual ~MpiSession() = default;

  virtual size_t rank() const = 0;
  virtual size_t size() const = 0;
  /// For rank 0: the other ranks' threads join those of `local`, which must outlive the crew.
  virtual std::unique_ptr<Crew> lead(Crew& local) = 0;
  /// For the other ranks: does tasks until dismissed.
  virtual Result<void> serve(Crew& local) = 0;
};

}  // namespace scarf::reprocess
