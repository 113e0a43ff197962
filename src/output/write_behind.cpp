#include "output/write_behind.h"

#include <exception>
#include <new>

#include "core/text.h"

namespace scarf {
namespace {

constexpr size_t kBehind = 4;  // frames

Result<void> write_one(FrameWriter& writer, const Frame& frame, const WriteBehind::Picture& picture) {
  try {  // an exception, of OpenCV say, must not leave the thread
    return std::visit([&](const auto& image) { return writer.write(frame, image); }, picture);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "out of memory while writing a picture"};
  } catch (const std::exception& e) {
    return Error{ErrorCode::io, text("cannot write a picture: ", e.what())};
  }
}

WriteBehind::Picture copy_of(const PictureView& picture) {
  return std::visit(
      [&](const auto pixels) -> WriteBehind::Picture {
        Image<typename decltype(pixels)::value_type> image;
        image.width = picture.size.width;
        image.height = picture.size.height;
        image.pixels.assign(pixels.begin(), pixels.end());
        return image;
      },
      picture.pixels);
}

}  // namespace

WriteBehind::WriteBehind(std::unique_ptr<FrameWriter> writer)
    : writer_(std::move(writer)), frames_(kBehind), thread_([this] { write_all(); }) {}

WriteBehind::~WriteBehind() {
  frames_.abandon();
  if (thread_.joinable()) thread_.join();
}

void WriteBehind::write_all() {
  while (const auto next = frames_.take()) {
    const auto written = write_one(*writer_, next->first, *next->second);
    if (written) continue;
    {
      const std::lock_guard lock(mutex_);
      result_ = written;
    }
    frames_.abandon();
  }
}

Result<void> WriteBehind::so_far() {
  const std::lock_guard lock(mutex_);
  return result_;
}

Result<void> WriteBehind::write(const Frame& frame, const PictureView& picture) {
  frames_.put({frame, std::make_unique<Picture>(copy_of(picture))});  // refused only after an error
  return so_far();
}

Result<void> WriteBehind::finish() {
  frames_.close();
  if (thread_.joinable()) thread_.join();
  if (auto r = so_far(); !r) return r;
  return writer_->finish();
}

}  // namespace scarf
