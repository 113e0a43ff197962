#include "output/hdf5_writer.h"

#include <functional>
#include <numeric>
#include <utility>

#include "core/text.h"
#include "io/files/output_files.h"
#include "io/hdf5/event_columns.h"
#include "io/hdf5/growing_dataset.h"

namespace scarf {
namespace {

using hdf5::GrowingDataset;

// Numbers of frames in a chunk of the datasets that have one number per frame.
constexpr size_t kFramesPerChunk = 4096;

// What both kinds of file have: the file itself, and times and counts of its frames.
struct FrameFile {
  explicit FrameFile(OutputFile to) : path(to.path()), output(std::move(to)) {}

  Result<void> create(const std::string& counts_name) {
    auto made = hdf5::WrittenFile::create(output.name(), path);
    if (!made) return made.error();
    file = *std::move(made);
    auto t = GrowingDataset::create<int64_t>(file, "times", {}, kFramesPerChunk);
    if (!t) return t.error();
    times = *std::move(t);
    auto n = GrowingDataset::create<uint64_t>(file, counts_name, {}, kFramesPerChunk);
    if (!n) return n.error();
    counts = *std::move(n);
    return {};
  }

  Result<void> append(const Frame& frame) {
    if (auto r = times.append(std::span(&frame.t, 1)); !r) return r;
    return counts.append(std::span(&frame.events, 1));
  }

  // Closes the file behind its datasets.
  Result<void> finish(std::initializer_list<std::reference_wrapper<GrowingDataset>> others) {
    for (GrowingDataset& dataset : others) {
      if (auto r = dataset.close(); !r) return r.error();
    }
    if (auto r = times.close(); !r) return r.error();
    if (auto r = counts.close(); !r) return r.error();
    if (auto r = file.close(); !r) return r.error();
    return output.publish();
  }

  const std::string path;
  OutputFile output;
  hdf5::WrittenFile file;
  GrowingDataset times;
  GrowingDataset counts;
};

class ArrayWriter final : public Hdf5ArrayWriter {
 public:
  ArrayWriter(OutputFile output, Hdf5Element element, std::vector<size_t> shape)
      : out_(std::move(output)), element_(element), shape_(std::move(shape)) {}

  Result<void> create(std::string_view dataset) {
    if (auto r = out_.create("events"); !r) return r;
    auto made = element_ == Hdf5Element::u8
                    ? GrowingDataset::create<uint8_t>(out_.file, std::string(dataset), shape_, 1)
                    : GrowingDataset::create<float>(out_.file, std::string(dataset), shape_, 1);
    if (!made) return made.error();
    arrays_ = *std::move(made);
    return {};
  }

  Result<void> write(const Frame& frame, std::span<const uint8_t> values) override {
    return append(frame, values, Hdf5Element::u8);
  }
  Result<void> write(const Frame& frame, std::span<const float> values) override {
    return append(frame, values, Hdf5Element::f32);
  }
  Result<void> finish() override { return out_.finish({arrays_}); }

 private:
  template <class T>
  Result<void> append(const Frame& frame, std::span<const T> values, Hdf5Element element) {
    const size_t expected = std::accumulate(shape_.begin(), shape_.end(), size_t{1}, std::multiplies<>());
    if (element != element_ || values.size() != expected) {
      return Error{ErrorCode::illegal_parameter,
                   text(out_.path, ": an array of ", values.size(), " values of ", sizeof(T),
                        " bytes is not what the file was created for: ", expected, " of ",
                        element_ == Hdf5Element::u8 ? 1 : 4)};
    }
    if (auto r = arrays_.append(values); !r) return r.error();
    if (auto r = out_.append(frame); !r) return r.error();
    return {};
  }

  FrameFile out_;
  const Hdf5Element element_;
  const std::vector<size_t> shape_;
  GrowingDataset arrays_;
};

class EventsWriter final : public EventListWriter {
 public:
  explicit EventsWriter(OutputFile output) : out_(std::move(output)) {}

  Result<void> create(SensorSize sensor) {
    if (auto r = out_.create("stream_events"); !r) return r;
    auto columns = hdf5::EventColumns<int64_t>::create(out_.file, sensor);
    if (!columns) return columns.error();
    columns_ = *std::move(columns);
    auto offsets = GrowingDataset::create<uint64_t>(out_.file, "frame_offsets", {}, kFramesPerChunk);
    if (!offsets) return offsets.error();
    offsets_ = *std::move(offsets);
    return append_offset();
  }

  Result<void> write(const Frame& frame, std::span<const Event> events) override {
    if (auto r = columns_.append(events, 0); !r) return r.error();
    count_ += events.size();
    if (auto r = append_offset(); !r) return r;
    if (auto r = out_.append(frame); !r) return r.error();
    return {};
  }

  Result<void> finish() override {
    if (auto r = columns_.close(); !r) return r.error();
    return out_.finish({offsets_});
  }

 private:
  Result<void> append_offset() {
    if (auto r = offsets_.append(std::span<const uint64_t>(&count_, 1)); !r) return r.error();
    return {};
  }

  FrameFile out_;
  hdf5::EventColumns<int64_t> columns_;
  GrowingDataset offsets_;
  uint64_t count_ = 0;
};

}  // namespace

Result<std::unique_ptr<Hdf5ArrayWriter>> create_hdf5_arrays(const std::string& path, std::string_view dataset,
                                                            Hdf5Element element, std::vector<size_t> shape,
                                                            const OutputRule& rule) {
  auto output = OutputFile::create(path, rule);
  if (!output) return output.error();
  auto writer = std::make_unique<ArrayWriter>(*std::move(output), element, std::move(shape));
  if (auto r = writer->create(dataset); !r) return r.error();
  return std::unique_ptr<Hdf5ArrayWriter>(std::move(writer));
}

Result<std::unique_ptr<EventListWriter>> create_hdf5_events(const std::string& path, SensorSize sensor,
                                                            const OutputRule& rule) {
  auto output = OutputFile::create(path, rule);
  if (!output) return output.error();
  auto writer = std::make_unique<EventsWriter>(*std::move(output));
  if (auto r = writer->create(sensor); !r) return r.error();
  return std::unique_ptr<EventListWriter>(std::move(writer));
}

}  // namespace scarf
