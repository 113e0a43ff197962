// What every representation on a device has in common: it is fed through a Stream.
#pragma once

#include <memory>
#include <utility>

#include "gpu/stream.h"
#include "scarf/gpu.h"

namespace scarf {

/// Implements all of GpuRepresentation but its queries, for an Interface derived from it.
template <class Interface>
class OnDevice : public Interface {
 public:
  explicit OnDevice(std::shared_ptr<Stream> stream) : stream_(std::move(stream)) {}

  Result<PushReport> push(std::span<const Event> events) override { return stream_->push(events); }
  Result<void> reset() override { return stream_->reset(); }
  Result<std::span<Event>> acquire(size_t n) override { return stream_->acquire(n); }
  Result<PushReport> commit(size_t count) override { return stream_->commit(count); }
  size_t max_acquire() const override { return stream_->max_acquire(); }
  Result<void> flush() override { return stream_->flush(); }
  Result<void> finish() override { return stream_->finish(); }
  std::vector<StageTime> stage_times() const override { return stream_->stage_times(); }
  uint64_t memory_bytes() const override { return stream_->memory_bytes(); }

 protected:
  std::shared_ptr<Stream> stream_;
};

}  // namespace scarf
