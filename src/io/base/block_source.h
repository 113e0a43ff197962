// What readers of formats share whose events come in blocks: packets, messages, chunks of arrays.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/base/event_tally.h"
#include "scarf/io/recordings.h"

namespace scarf {

class BlockSource : public EventSource {
 public:
  /// `name` is what error messages call the file.
  BlockSource(std::string name, std::optional<SensorSize> sensor, const ReadOptions& options);

  std::optional<SensorSize> sensor() const final { return tally_.sensor(); }
  Result<size_t> read(std::span<Event> out) final;
  const ReadReport& report() const final { return tally_.report; }

 protected:
  /// Puts the events of the next block into `block`, which is empty; it may stay empty. False: there is no
  /// further block. Broken blocks are passed over with tally_.note_damage; errors are for what cannot be
  /// passed over.
  virtual Result<bool> next(std::vector<Event>& block) = 0;

  EventTally tally_;

 private:
  std::string name_;
  std::vector<Event> block_;
  size_t at_ = 0;  // events of the block handed out
  bool ended_ = false;
};

}  // namespace scarf
