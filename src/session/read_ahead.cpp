#include "session/read_ahead.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "core/text.h"

namespace scarf {
namespace {

constexpr size_t kBatch = 65'536;  // events: 1 MiB
constexpr size_t kAhead = 4;       // batches

}  // namespace

ReadAhead::ReadAhead(std::unique_ptr<EventSource> source, std::function<void(std::span<const Event>)> seen)
    : source_(std::move(source)),
      seen_(std::move(seen)),
      sensor_(source_->sensor()),
      bytes_total_(source_->bytes_total()),
      batches_(kAhead),
      thread_([this] { read_all(); }) {}

ReadAhead::~ReadAhead() {
  batches_.abandon();
  if (thread_.joinable()) thread_.join();
}

void ReadAhead::read_all() {
  try {  // an exception must not leave the thread
    while (true) {
      std::vector<Event> batch(kBatch);
      const auto n = source_->read(batch);
      bytes_read_ = source_->bytes_read();
      if (!n) batches_.put(n.error());
      if (!n || *n == 0) break;
      batch.resize(*n);
      if (seen_) seen_(batch);
      if (!batches_.put(std::move(batch))) break;
    }
  } catch (const std::bad_alloc&) {
    batches_.put(Error{ErrorCode::out_of_memory, "out of memory while reading"});
  } catch (const std::exception& e) {
    batches_.put(Error{ErrorCode::io, text("cannot read: ", e.what())});
  }
  batches_.close();
}

Result<size_t> ReadAhead::ended(Result<size_t> how) {
  if (thread_.joinable()) thread_.join();
  report_ = source_->report();
  return how;
}

Result<size_t> ReadAhead::read(std::span<Event> out) {
  if (used_ == current_.size()) {
    auto batch = batches_.take();
    if (!batch) return ended(size_t{0});
    if (!*batch) {
      batches_.abandon();
      return ended(batch->error());
    }
    current_ = **std::move(batch);
    used_ = 0;
  }
  const size_t n = std::min(out.size(), current_.size() - used_);
  std::copy_n(current_.begin() + static_cast<std::ptrdiff_t>(used_), n, out.begin());
  used_ += n;
  return n;
}

}  // namespace scarf
