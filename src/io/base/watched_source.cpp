#include "io/base/watched_source.h"

#include <utility>

#include "io/base/forwarding.h"

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

class WatchedEvents final : public ForwardingEvents {
 public:
  WatchedEvents(std::unique_ptr<EventSource> source, std::shared_ptr<const InputFiles> files)
      : ForwardingEvents(std::move(source)), files_(std::move(files)) {}

  Result<size_t> read(std::span<Event> out) override {
    return checked(source_->read(out), *files_, kNothing);
  }
  Result<void> unchanged() const override { return files_->unchanged(); }

 private:
  std::shared_ptr<const InputFiles> files_;
};

class WatchedFrames final : public ForwardingFrames {
 public:
  WatchedFrames(std::unique_ptr<FrameSource> source, std::shared_ptr<const InputFiles> files)
      : ForwardingFrames(std::move(source)), files_(std::move(files)) {}

  Result<std::optional<GreyFrame>> read() override {
    return checked(source_->read(), *files_, [](const auto& frame) { return !frame; });
  }

 private:
  std::shared_ptr<const InputFiles> files_;
};

class WatchedTriggers final : public ForwardingTriggers {
 public:
  WatchedTriggers(std::unique_ptr<TriggerSource> source, std::shared_ptr<const InputFiles> files)
      : ForwardingTriggers(std::move(source)), files_(std::move(files)) {}

  Result<size_t> read(std::span<Trigger> out) override {
    return checked(source_->read(out), *files_, kNothing);
  }

 private:
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
