#include "output/npz_events_writer.h"

#include <zip.h>

#include <array>
#include <ctime>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/files/output_files.h"
#include "output/npy_file.h"

namespace scarf {
namespace {

struct Column {
  const char* name;
  const char* type;
};
enum ColumnIndex { kX, kY, kP, kT, kOffsets, kTimes, kStreamEvents, kColumns };
constexpr Column kColumnsOfFile[kColumns] = {{"x", "<u2"},
                                             {"y", "<u2"},
                                             {"p", "|u1"},
                                             {"t", "<i8"},
                                             {"frame_offsets", "<u8"},
                                             {"times", "<i8"},
                                             {"stream_events", "<u8"}};

// The earliest time that an archive can hold, in any time zone: the same events make the same file.
time_t begin_of_zip_time() {
  std::tm begin{};
  begin.tm_year = 80;
  begin.tm_mday = 1;
  begin.tm_isdst = -1;
  return std::mktime(&begin);
}

// An archive's entries are written one after the other, but all arrays grow at once: they grow in files of
// a folder beside the archive, which is gone afterwards.
class NpzWriter final : public EventListWriter {
 public:
  NpzWriter(OutputFile output, ScratchFolder scratch)
      : output_(std::move(output)), scratch_(std::move(scratch)) {}

  Result<void> create() {
    for (const Column& column : kColumnsOfFile) {
      auto part = NpyFile::create(part_path(column), column.type, {}, OutputRule());
      if (!part) return part.error();
      parts_.push_back(*std::move(part));
    }
    return append_number(kOffsets, uint64_t{0});
  }

  Result<void> write(const Frame& frame, std::span<const Event> events) override {
    if (auto r = append(kX, events, &Event::x); !r) return r;
    if (auto r = append(kY, events, &Event::y); !r) return r;
    if (auto r = append(kP, events, &Event::p); !r) return r;
    if (auto r = append(kT, events, &Event::t); !r) return r;
    count_ += events.size();
    if (auto r = append_number(kOffsets, count_); !r) return r;
    if (auto r = append_number(kTimes, frame.t); !r) return r;
    return append_number(kStreamEvents, frame.events);
  }

  Result<void> finish() override {
    for (NpyFile& part : parts_) {
      if (auto r = part.finish(); !r) return r;
    }
    int code = 0;
    const std::string made = scratch_.file("archive.npz");
    zip_t* const archive = zip_open(made.c_str(), ZIP_CREATE | ZIP_EXCL, &code);
    if (archive == nullptr) {
      zip_error_t error;
      zip_error_init_with_code(&error, code);
      const Error told = failed(&error);
      zip_error_fini(&error);
      return told;
    }
    bool good = true;
    for (const Column& column : kColumnsOfFile) {
      zip_source_t* const source = zip_source_file(archive, part_path(column).c_str(), 0, -1);
      const int64_t index = source == nullptr ? -1
                                              : zip_file_add(archive, text(column.name, ".npy").c_str(),
                                                             source, ZIP_FL_OVERWRITE);
      good = good && index >= 0 &&
             zip_file_set_mtime(archive, static_cast<uint64_t>(index), begin_of_zip_time(), 0) == 0;
    }
    if (!good || zip_close(archive) != 0) {
      const Error told = failed(zip_get_error(archive));
      zip_discard(archive);
      return told;
    }
    if (auto r = output_.take(made); !r) return r;
    return output_.publish();
  }

 private:
  std::string part_path(const Column& column) const { return scratch_.file(text(column.name, ".npy")); }

  template <class T>
  Result<void> append(ColumnIndex column, std::span<const Event> events, T Event::*field) {
    std::vector<T> values;
    values.reserve(events.size());
    for (const Event& e : events) values.push_back(e.*field);
    return parts_[column].append(std::span<const T>(values));
  }
  template <class T>
  Result<void> append_number(ColumnIndex column, T number) {
    return parts_[column].append(std::span<const T>(&number, 1));
  }

  Error failed(zip_error_t* why) const {
    return {ErrorCode::io, text("cannot write ", output_.path(), ": ", zip_error_strerror(why))};
  }

  OutputFile output_;
  ScratchFolder scratch_;
  std::vector<NpyFile> parts_;
  uint64_t count_ = 0;
};

}  // namespace

Result<std::unique_ptr<EventListWriter>> create_npz_events(const std::string& path, const OutputRule& rule) {
  auto output = OutputFile::create(path, rule);
  if (!output) return output.error();
  auto scratch = ScratchFolder::create(path);
  if (!scratch) return scratch.error();
  auto writer = std::make_unique<NpzWriter>(*std::move(output), *std::move(scratch));
  if (auto r = writer->create(); !r) return r.error();
  return std::unique_ptr<EventListWriter>(std::move(writer));
}

}  // namespace scarf
