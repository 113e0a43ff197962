#include "io/base/memory_guard.h"

#include <utility>

#include "io/base/forwarding.h"

namespace scarf {
namespace {

// Runs calls until one does not come back.
class Guard {
 public:
  /// `sentence`: what is to be done after one.
  explicit Guard(const char* sentence) : sentence_(sentence) {}

  template <class Call>
  auto run(Call call) {
    using Answer = decltype(call());
    return as_result([&]() -> Answer {
      if (broken_) return Error{ErrorCode::out_of_memory, sentence_};
      broken_ = true;  // unless it comes back
      Answer answer = call();
      broken_ = false;
      return answer;
    });
  }

 private:
  const char* sentence_;
  bool broken_ = false;
};

constexpr const char* kReadAgain =
    "the reader ran out of memory, and where it stopped is not known; open the recording again";
constexpr const char* kWriteAgain =
    "the writer ran out of memory, and what it had written is not known; create the recording again";

class GuardedEvents final : public ForwardingEvents {
 public:
  using ForwardingEvents::ForwardingEvents;
  Result<size_t> read(std::span<Event> out) override {
    return guard_.run([&] { return source_->read(out); });
  }
  Result<void> unchanged() const override {
    return as_result([&] { return source_->unchanged(); });
  }

 private:
  Guard guard_{kReadAgain};
};

class GuardedFrames final : public ForwardingFrames {
 public:
  using ForwardingFrames::ForwardingFrames;
  Result<std::optional<GreyFrame>> read() override {
    return guard_.run([&] { return source_->read(); });
  }

 private:
  Guard guard_{kReadAgain};
};

class GuardedTriggers final : public ForwardingTriggers {
 public:
  using ForwardingTriggers::ForwardingTriggers;
  Result<size_t> read(std::span<Trigger> out) override {
    return guard_.run([&] { return source_->read(out); });
  }

 private:
  Guard guard_{kReadAgain};
};

class GuardedWords final : public ForwardingWords {
 public:
  using ForwardingWords::ForwardingWords;
  Result<size_t> read(std::span<uint8_t> out) override {
    return guard_.run([&] { return source_->read(out); });
  }
  Result<void> unchanged() const override {
    return as_result([&] { return source_->unchanged(); });
  }

 private:
  Guard guard_{kReadAgain};
};

class GuardedSink final : public EventSink {
 public:
  explicit GuardedSink(std::unique_ptr<EventSink> sink) : sink_(std::move(sink)) {}
  Result<void> write(std::span<const Event> events) override {
    return guard_.run([&] { return sink_->write(events); });
  }
  Result<void> write_header(std::span<const HeaderLine> lines) override {
    return guard_.run([&] { return sink_->write_header(lines); });
  }
  Result<void> write_triggers(std::span<const Trigger> triggers) override {
    return guard_.run([&] { return sink_->write_triggers(triggers); });
  }
  Result<void> finish() override {
    return guard_.run([&] { return sink_->finish(); });
  }

 private:
  std::unique_ptr<EventSink> sink_;
  Guard guard_{kWriteAgain};
};

}  // namespace

std::unique_ptr<EventSource> guarded(std::unique_ptr<EventSource> source) {
  return std::make_unique<GuardedEvents>(std::move(source));
}
std::unique_ptr<FrameSource> guarded(std::unique_ptr<FrameSource> source) {
  return std::make_unique<GuardedFrames>(std::move(source));
}
std::unique_ptr<TriggerSource> guarded(std::unique_ptr<TriggerSource> source) {
  return std::make_unique<GuardedTriggers>(std::move(source));
}
std::unique_ptr<WordSource> guarded(std::unique_ptr<WordSource> source) {
  return std::make_unique<GuardedWords>(std::move(source));
}
std::unique_ptr<EventSink> guarded(std::unique_ptr<EventSink> sink) {
  return std::make_unique<GuardedSink>(std::move(sink));
}

}  // namespace scarf
