// What bags have in common that are files of records, some of which are chunks of further records.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "io/base/byte_reader.h"
#include "io/base/decompressor.h"
#include "io/ros/ros_bag.h"

namespace scarf {

class RecordBag : public RosBag {
 public:
  explicit RecordBag(ByteReader input) : input_(std::move(input)) {}

  Result<std::optional<RosMessage>> next() final;
  uint64_t bytes_read() const final { return input_.consumed(); }
  uint64_t bytes_total() const final { return input_.total(); }

 protected:
  using Maybe = std::optional<RosMessage>;

  /// Reads a record outside of chunks; nullopt if it is no message, and no damage.
  virtual Result<Maybe> next_record() = 0;
  /// The same for the front of chunk_, which is not empty.
  virtual Maybe next_of_chunk() = 0;

  Maybe damage(std::string what, uint64_t truncated = 0) const;
  /// The end of what can be read: the rest of the file is counted.
  Result<Maybe> cut_short(std::string what);

  ByteReader input_;
  uint64_t byte_ = 0;  ///< of the record outside of chunks that was read last
  bool ended_ = false;
  std::map<Compression, Decompressor> decompressors_;
  std::span<const uint8_t> chunk_;  ///< what is left of the open chunk
};

}  // namespace scarf
