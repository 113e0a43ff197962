// What every representation on a device has in common: it is fed through a Stream, perhaps behind filters.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "device/stream.h"
#include "pipelines/filter/filter.h"
#include "scarf/device/stream.h"

namespace scarf {

/// A stream and the filters in front of its pipeline.
struct Feed {
  std::shared_ptr<Stream> stream;
  FilteredPipeline* filtered = nullptr;  ///< of the stream; null without filters

  /// See FilteredPipeline::create for `images` and `asks_for_newest`.
  static Result<Feed> create(std::shared_ptr<GpuContext> context, std::unique_ptr<Pipeline> pipeline,
                             ImagePipeline* images, bool asks_for_newest, const GpuOptions& options,
                             std::span<const FilterParameters> filters);
};

/// What functions say that are given a null context.
inline Error no_context() {
  return {ErrorCode::illegal_parameter, "the context is null; make one with GpuContext::create"};
}
/// Errors: illegal_parameter for a null context; device in a process that was forked from that of the
/// context.
Result<void> check_context(const std::shared_ptr<GpuContext>& context);

/// How a representation's u8_image() is recorded. May outlive the representation, not its stream.
struct U8Picture {
  std::function<Result<Answer<Image<uint8_t>>>(Query& query, const StreamFacts& facts,
                                               std::optional<int64_t> now)>
      record;
  bool changes_state = false;  ///< see Stream::query
};

/// What is fed through a Stream.
class StreamFed {
 public:
  virtual ~StreamFed() = default;
  virtual std::shared_ptr<Stream> stream() const = 0;
  virtual U8Picture u8_picture() const = 0;
};

/// Implements all of GpuRepresentation but its own queries, for an Interface derived from it.
template <class Interface>
class OnDevice : public Interface, public StreamFed {
 public:
  explicit OnDevice(Feed feed) : stream_(std::move(feed.stream)), filtered_(feed.filtered) {}

  Result<PushReport> push(std::span<const Event> events) override { return stream_->push(events); }
  Result<void> reset() override { return stream_->reset(); }
  Result<std::span<Event>> acquire(size_t n) override { return stream_->acquire(n); }
  Result<PushReport> commit(size_t count) override { return stream_->commit(count); }
  size_t max_acquire() const override { return stream_->max_acquire(); }
  Result<void> flush() override { return stream_->flush(); }
  Result<void> finish() override { return stream_->finish(); }
  std::vector<StageTime> stage_times() const override { return stream_->stage_times(); }
  uint64_t memory_bytes() const override { return stream_->memory_bytes(); }
  std::shared_ptr<Stream> stream() const override { return stream_; }
  Pending<std::vector<FilterReport>> filter_reports() override {
    using Reports = std::vector<FilterReport>;
    if (filtered_ == nullptr) return Reports();
    return stream_->query<Reports>(QueryKind::state,
                                   [this](Query&, const StreamFacts& facts) -> Result<Answer<Reports>> {
                                     return filtered_->reports(facts);
                                   });
  }

 protected:
  std::shared_ptr<Stream> stream_;
  FilteredPipeline* filtered_;
};

}  // namespace scarf
