// Writer of HDF5 in the layout of DSEC.
// Source: uzh-rpg/DSEC (eventslicer).
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/base/event_check.h"
#include "io/base/event_tally.h"
#include "io/base/writers.h"
#include "io/files/output_files.h"
#include "io/hdf5/event_columns.h"
#include "io/hdf5/growing_dataset.h"

namespace scarf {
namespace {

using hdf5::GrowingDataset;

constexpr size_t kBufferedEvents = 64 * 1024;
constexpr int64_t kTimeRange = int64_t{1} << 32;  // of times relative to the first

class DsecWriter final : public EventSink {
 public:
  DsecWriter(OutputFile output, SensorSize sensor)
      : path_(output.path()),
        output_(std::move(output)),
        check_(sensor, {.format = "dsec", .t_min = -kMaxTime + 1, .t_end = kMaxTime}) {}

  Result<void> create(SensorSize sensor) {
    auto file = hdf5::WrittenFile::create(output_.name(), path_);
    if (!file) return file.error();
    file_ = *std::move(file);
    auto columns = hdf5::EventColumns<uint32_t>::create(file_, sensor);
    if (!columns) return columns.error();
    columns_ = *std::move(columns);
    auto index = GrowingDataset::create<uint64_t>(file_, "ms_to_idx", {}, kBufferedEvents);
    if (!index) return index.error();
    index_ = *std::move(index);
    return {};
  }

  Result<void> write(std::span<const Event> events) override {
    if (!file_)
      return Error{ErrorCode::io, text(path_, ": is finished already; create it anew to write more")};
    while (!events.empty()) {
      const auto part = events.first(std::min(events.size(), kBufferedEvents - buffer_.size()));
      if (!origin_ && check_.accepts(part.front())) {
        origin_ = part.front().t;
        check_.set_t_end(*origin_ + kTimeRange);
      }
      const size_t good = check_.accepted(part);
      buffer_.insert(buffer_.end(), part.begin(), part.begin() + static_cast<ptrdiff_t>(good));
      if (buffer_.size() == kBufferedEvents) {
        if (auto r = flush(); !r) return r;
      }
      if (good < part.size()) return check_.refusal(path_, part[good]);
      events = events.subspan(good);
    }
    return {};
  }

  Result<void> finish() override {
    if (!file_) return Error{ErrorCode::io, text(path_, ": is finished already")};
    if (auto r = flush(); !r) return r;
    // One more: the first millisecond behind the last event.
    if (auto r = extend_index(milliseconds_, count_); !r) return r;
    if (auto r = write_index(); !r) return r;
    if (auto r = hdf5::write_scalar(file_, "t_offset", origin_.value_or(0)); !r) return r;
    if (auto r = index_.close(); !r) return r;
    if (auto r = columns_.close(); !r) return r;
    if (auto r = file_.close(); !r) return r;
    return output_.publish();
  }

 private:
  Result<void> flush() {
    for (size_t i = 0; i < buffer_.size(); ++i) {
      // Entry k: the first event at k milliseconds or later.
      const auto reached = static_cast<uint64_t>((buffer_[i].t - *origin_) / 1000);
      if (auto r = extend_index(reached, count_ + i); !r) return r;
    }
    if (auto r = columns_.append(buffer_, origin_.value_or(0)); !r) return r;
    count_ += buffer_.size();
    buffer_.clear();
    return write_index();
  }

  // Gives all milliseconds up to `last` the event `event`, unless they have one.
  Result<void> extend_index(uint64_t last, uint64_t event) {
    for (; milliseconds_ <= last; ++milliseconds_) {
      entries_.push_back(event);
      if (entries_.size() < kBufferedEvents) continue;
      if (auto r = write_index(); !r) return r;
    }
    return {};
  }

  Result<void> write_index() {
    if (auto r = index_.append(std::span<const uint64_t>(entries_)); !r) return r;
    entries_.clear();
    return {};
  }

  const std::string path_;
  OutputFile output_;
  EventCheck check_;
  hdf5::WrittenFile file_;
  hdf5::EventColumns<uint32_t> columns_;
  GrowingDataset index_;
  std::optional<int64_t> origin_;  // of the first event
  std::vector<Event> buffer_;
  std::vector<uint64_t> entries_;  // of the index, not yet written
  uint64_t milliseconds_ = 0;      // entries of the index
  uint64_t count_ = 0;             // events written
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_dsec(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  if (path == "-")
    return Error{ErrorCode::illegal_parameter, "HDF5 cannot be written to standard output; name a file"};
  auto output = OutputFile::create(path, rule);
  if (!output) return output.error();
  auto writer = std::make_unique<DsecWriter>(*std::move(output), sensor);
  if (auto r = writer->create(sensor); !r) return r.error();
  return std::unique_ptr<EventSink>(std::move(writer));
}

}  // namespace scarf
