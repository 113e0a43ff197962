#include "io/files/byte_writer.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/text.h"

namespace scarf {
namespace {

Error system_error(const std::string& path, const char* what) {
  return {ErrorCode::io, text(path, ": ", what, ": ", std::generic_category().message(errno))};
}

}  // namespace

Result<ByteWriter> ByteWriter::create(const std::string& path, const OutputRule& rule) {
  auto file = OutputFile::create(path, rule);
  if (!file) return file.error();
  return ByteWriter(*std::move(file));
}

Result<void> ByteWriter::flush() {
  if (finished_)
    return Error{ErrorCode::io, text(path(), ": is finished already; create it anew to write more")};
  for (size_t at = 0; at < buffer_.size();) {
    const ssize_t count = write(file_.descriptor(), buffer_.data() + at, buffer_.size() - at);
    if (count >= 0)
      at += static_cast<size_t>(count);
    else if (errno != EINTR)
      return system_error(path(), "cannot write");
  }
  buffer_.clear();
  return {};
}

Result<void> ByteWriter::overwrite(uint64_t offset, std::string_view bytes) {
  if (const auto flushed = flush(); !flushed) return flushed;
  while (!bytes.empty()) {
    const ssize_t count = pwrite(file_.descriptor(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno != EINTR) return system_error(path(), "cannot complete");
    if (count <= 0) continue;
    bytes.remove_prefix(static_cast<size_t>(count));
    offset += static_cast<uint64_t>(count);
  }
  return {};
}

Result<void> ByteWriter::finish() {
  if (const auto flushed = flush(); !flushed) return flushed;
  finished_ = true;
  return file_.publish();
}

}  // namespace scarf
