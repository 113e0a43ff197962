#include "tools/npz_events_writer.h"

#include <zip.h>

#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/atomic_file.h"
#include "tools/npy_file.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;

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

// An archive's entries are written one after the other, but all arrays grow at once: they grow in files
// beside the archive, which are gone afterwards.
class NpzWriter final : public EventListWriter {
 public:
  explicit NpzWriter(const std::string& path) : path_(path), place_(path) {}
  ~NpzWriter() override { remove_parts(); }

  Result<void> create() {
    for (const Column& column : kColumnsOfFile) {
      auto part = NpyFile::create(part_path(column), column.type, {});
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
    zip_t* const archive = zip_open(place_.name().c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
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
      good = good && source != nullptr &&
             zip_file_add(archive, text(column.name, ".npy").c_str(), source, ZIP_FL_OVERWRITE) >= 0;
    }
    if (!good || zip_close(archive) != 0) {
      const Error told = failed(zip_get_error(archive));
      zip_discard(archive);
      return told;
    }
    remove_parts();
    return place_.put_in_place();
  }

 private:
  std::string part_path(const Column& column) const { return text(place_.name(), ".", column.name, ".npy"); }

  void remove_parts() const {
    std::error_code ignored;
    for (const Column& column : kColumnsOfFile) fs::remove(part_path(column), ignored);
  }

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
    return {ErrorCode::io, text("cannot write ", path_, ": ", zip_error_strerror(why))};
  }

  const std::string path_;
  AtomicFile place_;
  std::vector<NpyFile> parts_;
  uint64_t count_ = 0;
};

}  // namespace

Result<std::unique_ptr<EventListWriter>> create_npz_events(const std::string& path) {
  auto writer = std::make_unique<NpzWriter>(path);
  if (auto r = writer->create(); !r) return r.error();
  return std::unique_ptr<EventListWriter>(std::move(writer));
}

}  // namespace scarf::tools
