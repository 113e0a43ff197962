// The greyscale frames of MVSEC: davis/<stream>/image_raw and image_raw_ts.
// Source: daniilidis-group/mvsec.
#include <utility>

#include "core/text.h"
#include "io/base/sensor_size.h"
#include "io/hdf5/dataset.h"
#include "io/hdf5/layouts.h"
#include "io/hdf5/number_type.h"
#include "io/hdf5/reader.h"

namespace scarf::hdf5 {
namespace {

class MvsecFrames final : public FrameSource {
 public:
  MvsecFrames(Handle file, Dataset images, Dataset times, SensorSize size, std::string name)
      : file_(std::move(file)),
        images_(std::move(images)),
        times_(std::move(times)),
        size_(size),
        name_(std::move(name)) {}

  Result<std::optional<GreyFrame>> read() override {
    if (at_ == images_.rows()) return std::optional<GreyFrame>();
    double seconds = 0;
    if (auto r = times_.read(at_, 1, H5T_NATIVE_DOUBLE, &seconds); !r) return broken(times_, r.error());
    GreyFrame frame;
    frame.t = nearest_integer(seconds * 1e6);
    if (frame.t == kNoInteger) return broken(times_, {ErrorCode::bad_input, "no time"});
    frame.exposure_begin = frame.t;
    frame.exposure_end = frame.t;
    frame.image = Image<uint8_t>(size_.width, size_.height);
    if (auto r = images_.read(at_, 1, H5T_NATIVE_UINT8, frame.image.pixels.data()); !r)
      return broken(images_, r.error());
    ++at_;
    return std::optional(std::move(frame));
  }

 private:
  Error broken(const Dataset& dataset, const Error& why) const {
    if (const auto r = check_reading(file_); !r) return {ErrorCode::io, text(name_, ": ", r.error().message)};
    return {ErrorCode::bad_input, text(name_, ": frame ", at_, " in ", dataset.path(), ": ", why.message)};
  }

  Handle file_;
  Dataset images_;
  Dataset times_;
  SensorSize size_;
  std::string name_;
  uint64_t at_ = 0;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> open_mvsec_frames(Input input, const ReadOptions& options) {
  if (auto r = require_path(input, "HDF5"); !r) return r.error();
  const Turn turn;
  auto file = open_file(input.path);
  if (!file) return file.error();
  const Layout* const layout = find_layout(*file, Family::mvsec);
  if (auto r = check_reading(*file); !r) return r.error();
  if (layout == nullptr) return Error{ErrorCode::bad_input, "has no events as mvsec has them"};
  const auto events = place_of(*file, *layout, options.stream);
  if (!events) return events.error();
  const std::string camera = events->substr(0, events->rfind('/'));
  auto images = Dataset::open(*file, camera + "/image_raw");
  if (!images) return images.error();
  auto times = Dataset::open(*file, camera + "/image_raw_ts");
  if (!times) return times.error();
  const Handle type = images->type();
  if (images->shape().size() != 3 || number_type(type.id()) != NumberType::u8 || times->row_values() != 1 ||
      images->rows() != times->rows()) {
    return Error{ErrorCode::bad_input,
                 text(images->path(), " and ", times->path(), " are no frames of bytes with a time each")};
  }
  const auto size = checked_sensor(static_cast<int64_t>(images->shape()[2]),
                                   static_cast<int64_t>(images->shape()[1]), images->path());
  if (!size) return size.error();
  if (auto r = check_reading(*file); !r) return r.error();
  return std::unique_ptr<FrameSource>(std::make_unique<MvsecFrames>(*std::move(file), *std::move(images),
                                                                    *std::move(times), *size, input.name));
}

}  // namespace scarf::hdf5
