// Sources and sinks around others: all calls go through, and what is special to one is overridden. Those that
// stand in front of a source derive from these, so that a new question to sources is forwarded in one place.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"
#include "scarf/io/words.h"

namespace scarf {

class ForwardingEvents : public EventSource {
 public:
  explicit ForwardingEvents(std::unique_ptr<EventSource> source) : source_(std::move(source)) {}

  std::string_view format() const override { return source_->format(); }
  std::optional<SensorSize> sensor() const override { return source_->sensor(); }
  Result<size_t> read(std::span<Event> out) override { return source_->read(out); }
  Result<void> unchanged() const override { return source_->unchanged(); }
  std::span<const HeaderLine> header() const override { return source_->header(); }
  const ReadReport& report() const override { return source_->report(); }
  uint64_t bytes_read() const override { return source_->bytes_read(); }
  uint64_t bytes_total() const override { return source_->bytes_total(); }

 protected:
  const std::unique_ptr<EventSource> source_;
};

class ForwardingFrames : public FrameSource {
 public:
  explicit ForwardingFrames(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  Result<std::optional<GreyFrame>> read() override { return source_->read(); }
  const PassedFrames& passed_over() const override { return source_->passed_over(); }

 protected:
  const std::unique_ptr<FrameSource> source_;
};

class ForwardingTriggers : public TriggerSource {
 public:
  explicit ForwardingTriggers(std::unique_ptr<TriggerSource> source) : source_(std::move(source)) {}

  Result<size_t> read(std::span<Trigger> out) override { return source_->read(out); }

 protected:
  const std::unique_ptr<TriggerSource> source_;
};

class ForwardingWords : public WordSource {
 public:
  explicit ForwardingWords(std::unique_ptr<WordSource> source) : source_(std::move(source)) {}

  std::string_view format() const override { return source_->format(); }
  std::optional<SensorSize> sensor() const override { return source_->sensor(); }
  Result<size_t> read(std::span<uint8_t> out) override { return source_->read(out); }
  Result<void> unchanged() const override { return source_->unchanged(); }

 protected:
  const std::unique_ptr<WordSource> source_;
};

}  // namespace scarf
