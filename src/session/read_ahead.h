// A recording that a thread of its own reads and decodes, a few batches ahead of who needs them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "scarf/io/recordings.h"
#include "session/hand_over.h"

namespace scarf {

class ReadAhead final : public EventSource {
 public:
  /// `seen` is called by the reading thread with all events, in order.
  explicit ReadAhead(std::unique_ptr<EventSource> source,
                     std::function<void(std::span<const Event>)> seen = {});
  ~ReadAhead() override;
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  std::string_view format() const override { return source_->format(); }
  std::optional<SensorSize> sensor() const override { return sensor_; }
  Result<size_t> read(std::span<Event> out) override;
  Result<void> unchanged() const override { return source_->unchanged(); }
  std::span<const HeaderLine> header() const override { return source_->header(); }
  /// Empty until read() has returned 0 or an error; `seen` is done by then too.
  const ReadReport& report() const override { return report_; }
  uint64_t bytes_read() const override { return bytes_read_; }
  uint64_t bytes_total() const override { return bytes_total_; }

 private:
  void read_all();
  Result<size_t> ended(Result<size_t> how);

  const std::unique_ptr<EventSource> source_;
  const std::function<void(std::span<const Event>)> seen_;
  const std::optional<SensorSize> sensor_;
  const uint64_t bytes_total_;
  std::atomic<uint64_t> bytes_read_ = 0;
  HandOver<Result<std::vector<Event>>> batches_;
  std::vector<Event> current_;
  size_t used_ = 0;  // of current_
  ReadReport report_;
  std::thread thread_;
};

}  // namespace scarf
