#include "io/watched_source.h"

#include <utility>

namespace scarf {
namespace {

// What read() returned, or the error that the files have changed: `end` tells the values that end a stream.
template <class T, class End>
Result<T> checked(Result<T> read, const InputFiles& files, End end) {
  if (!read) return reason(files, read.error());
  if (!end(*read)) return read;
  if (auto r = files.unchanged(); !r) return r.error();
  return read;
}

constexpr auto kNothing = [](size_t count) { return count == 0; };

class WatchedEvents final : public EventSource {
 public:
  WatchedEvents(std::unique_ptr<EventSource> source, std::shared_ptr<const InputFiles> files)
      : source_(std::move(source)), files_(std::move(files)) {}

  std::string_view format() const override { return source_->format(); }
  std::optional<SensorSize> sensor() const override { return source_->sensor(); }
  Result<size_t> read(std::span<Event> out) override {
    return checked(source_->read(out), *files_, kNothing);
  }
  Result<void> unchanged() const override { return files_->unchanged(); }
  const ReadReport& report() const override { return source_->report(); }
  uint64_t bytes_read() const override { return source_->bytes_read(); }
  uint64_t bytes_total() const override { return source_->bytes_total(); }

 private:
  std::unique_ptr<EventSource> source_;
  std::shared_ptr<const InputFiles> files_;
};

class WatchedFrames final : public FrameSource {
 public:
  WatchedFrames(std::unique_ptr<FrameSource> source, std::shared_ptr<const InputFiles> files)
      : source_(std::move(source)), files_(std::move(files)) {}

  Result<std::optional<GreyFrame>> read() override {
    return checked(source_->read(), *files_, [](const auto& frame) { return !frame; });
  }

 private:
  std::unique_ptr<FrameSource> source_;
  std::shared_ptr<const InputFiles> files_;
};

class WatchedTriggers final : public TriggerSource {
 public:
  WatchedTriggers(std::unique_ptr<TriggerSource> source, std::shared_ptr<const InputFiles> files)
      : source_(std::move(source)), files_(std::move(files)) {}

  Result<size_t> read(std::span<Trigger> out) override {
    return checked(source_->read(out), *files_, kNothing);
  }

 private:
  std::unique_ptr<TriggerSource> source_;
  std::shared_ptr<const InputFiles> files_;
};

}  // namespace

std::unique_ptr<EventSource> watched(std::unique_ptr<EventSource> source,
                                     std::shared_ptr<const InputFiles> files) {
  return std::make_unique<WatchedEvents>(std::move(source), std::move(files));
}

std::unique_ptr<FrameSource> watched(std::unique_ptr<FrameSource> source,
                                     std::shared_ptr<const InputFiles> files) {
  return std::make_unique<WatchedFrames>(std::move(source), std::move(files));
}

std::unique_ptr<TriggerSource> watched(std::unique_ptr<TriggerSource> source,
                                       std::shared_ptr<const InputFiles> files) {
  return std::make_unique<WatchedTriggers>(std::move(source), std::move(files));
}

Error reason(const InputFiles& files, Error error) {
  const auto unchanged = files.unchanged();
  return unchanged ? std::move(error) : unchanged.error();
}

}  // namespace scarf
