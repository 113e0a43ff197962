// Names of what is unfinished, so that a signal that ends the program leaves nothing of it behind.
#pragma once

#include <functional>
#include <string>

namespace scarf {

/// A file or folder of this process that a signal removes, see remove_temporaries_on_signals().
class TemporaryName {
 public:
  enum class Kind {
    file,
    folder,        ///< with all that is in it
    empty_folder,  ///< only if nothing is in it
  };

  /// Notes nothing.
  TemporaryName() = default;
  /// Forgets the name; what is there stays.
  ~TemporaryName() { forget(); }
  TemporaryName(TemporaryName&& other) noexcept;
  TemporaryName& operator=(TemporaryName&& other) noexcept;
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  /// Calls `make`, which makes what has this name or returns false and leaves errno; no signal finds it made
  /// and not noted. Returns what `make` did.
  bool note(const std::string& path, Kind kind, const std::function<bool()>& make);
  void forget();

 private:
  struct Entry;
  friend struct Temporaries;

  Entry* entry_ = nullptr;
};

/// From now on, signals that would end the program remove all that is noted first; the program then ends as
/// without this, by the same signal. Signals that are ignored or handled already stay so.
void remove_temporaries_on_signals();

}  // namespace scarf
