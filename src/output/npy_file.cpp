#include "output/npy_file.h"

#include <functional>
#include <numeric>
#include <utility>

#include "core/text.h"
#include "io/numpy/numpy_header.h"

namespace scarf {
namespace {

// Magic, version and header: a multiple of 64, and enough for any number of rows.
constexpr size_t kHeaderBytes = 128;

}  // namespace

Result<NpyFile> NpyFile::create(const std::string& path, std::string type, std::vector<size_t> row,
                                const OutputRule& rule) {
  auto writer = ByteWriter::create(path, rule);
  if (!writer) return writer.error();
  NpyFile file(*std::move(writer), std::move(type), std::move(row));
  file.file_.append(file.header(0));
  return file;
}

Result<void> NpyFile::append_bytes(std::string_view bytes) {
  file_.append(bytes);
  bytes_ += bytes.size();
  return file_.flush_if_large();
}

Result<void> NpyFile::finish() {
  // The last character of a type is the size of an element.
  const auto element = static_cast<uint64_t>(type_.back() - '0');
  const uint64_t row_bytes = std::accumulate(row_.begin(), row_.end(), element, std::multiplies<>());
  if (auto r = file_.overwrite(0, header(bytes_ / row_bytes)); !r) return r;
  return file_.finish();
}

std::string NpyFile::header(uint64_t rows) const {
  std::string shape = text("(", rows, ",");
  for (const size_t n : row_) shape += text(" ", n, ",");
  return numpy_header_text(text("'", type_, "'"), shape + ")", kHeaderBytes);
}

}  // namespace scarf
