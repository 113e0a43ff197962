#include "tools/npy_file.h"

#include <functional>
#include <numeric>
#include <utility>

#include "core/text.h"
#include "io/numpy_header.h"

namespace scarf::tools {
namespace {

// Magic, version and header: a multiple of 64, and enough for any number of rows.
constexpr size_t kHeaderBytes = 128;

}  // namespace

NpyFile::NpyFile(const std::string& path, std::string type, std::vector<size_t> row)
    : path_(path),
      type_(std::move(type)),
      row_(std::move(row)),
      place_(std::make_unique<AtomicFile>(path)),
      file_(place_->name(), std::ios::binary | std::ios::trunc) {}

Result<NpyFile> NpyFile::create(const std::string& path, std::string type, std::vector<size_t> row) {
  NpyFile file(path, std::move(type), std::move(row));
  file.file_ << file.header(0);
  if (!file.file_) return file.failed();
  return file;
}

Result<void> NpyFile::append_bytes(std::span<const char> bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes_ += bytes.size();
  return file_ ? Result<void>() : Result<void>(failed());
}

Result<void> NpyFile::finish() {
  // The last character of a type is the size of an element.
  const auto element = static_cast<uint64_t>(type_.back() - '0');
  const uint64_t row_bytes = std::accumulate(row_.begin(), row_.end(), element, std::multiplies<>());
  file_.seekp(0);
  file_ << header(bytes_ / row_bytes);
  file_.close();
  if (!file_) return failed();
  return place_->put_in_place();
}

std::string NpyFile::header(uint64_t rows) const {
  std::string shape = text("(", rows, ",");
  for (const size_t n : row_) shape += text(" ", n, ",");
  return numpy_header_text(text("'", type_, "'"), shape + ")", kHeaderBytes);
}

Error NpyFile::failed() const {
  return {ErrorCode::io, text("cannot write ", path_, "; check that its folder is there and has room")};
}

}  // namespace scarf::tools
