#include "io/ros/ros_packed_messages.h"

#include <utility>

#include "core/text.h"
#include "io/base/decompressor.h"

namespace scarf {
namespace {

class UnpackedMessages final : public RosBag {
 public:
  explicit UnpackedMessages(std::unique_ptr<RosBag> bag) : bag_(std::move(bag)) {}

  Result<std::optional<RosMessage>> next() override {
    auto message = bag_->next();
    if (!message || !*message) return message;
    RosMessage& m = **message;
    if (!m.damage.empty() || m.serialization != RosSerialization::cdr || !looks_like_zstd(m.bytes)) {
      return message;
    }
    if (!decompressor_) {
      auto made = Decompressor::make(Compression::zstd);
      if (!made) return made.error();
      decompressor_.emplace(*std::move(made));
    }
    const auto bytes = decompressor_->unpack(m.bytes);
    if (bytes) {
      m.bytes = *bytes;
    } else {
      m.damage = text("a message on ", m.topic, " cannot be unpacked: ", bytes.error().message);
    }
    return message;
  }

  uint64_t bytes_read() const override { return bag_->bytes_read(); }
  uint64_t bytes_total() const override { return bag_->bytes_total(); }

 private:
  std::unique_ptr<RosBag> bag_;
  std::optional<Decompressor> decompressor_;
};

}  // namespace

std::unique_ptr<RosBag> with_unpacked_messages(std::unique_ptr<RosBag> bag) {
  return std::make_unique<UnpackedMessages>(std::move(bag));
}

}  // namespace scarf
