#include "session/device_words.h"

#include <utility>

namespace scarf {

Result<DeviceWords> DeviceWords::open(const StreamRequest& options, std::span<Representation* const> to) {
  const ReadOptions& read = options.read;
  if (read.time_policy != TimePolicy::keep || read.out_of_sensor != OutOfSensor::drop ||
      read.time_shift != TimeShift::none || read.strict) {
    return Error{
        ErrorCode::illegal_parameter,
        "a device decodes words as they are; leave out ReadOptions::time_policy, "
        "ReadOptions::out_of_sensor, ReadOptions::time_shift and ReadOptions::strict, or decode on the host"};
  }
  DeviceWords words;
  auto source = open_words(options.file, read);
  if (!source) return source.error();
  words.source_ = *std::move(source);
  const auto format = words.source_->format() == "evt2" ? CameraWords::evt2 : CameraWords::evt3;
  for (Representation* r : to) {
    auto* const on_device = dynamic_cast<GpuRepresentation*>(r);
    if (on_device == nullptr) {
      return Error{
          ErrorCode::illegal_parameter,
          "decoding on the device needs a device for everything that is shown; decode on the host, or leave "
          "out StreamRequest::cpu and what the host alone computes"};
    }
    auto decoder = make_gpu_decoder(*on_device, format);
    if (!decoder) return decoder.error();
    words.decoders_.push_back(*std::move(decoder));
  }
  return words;
}

Result<size_t> DeviceWords::push(size_t bytes) {
  if (bytes_.size() < bytes) bytes_.resize(bytes);
  const auto count = source_->read(std::span(bytes_).first(bytes));
  if (!count) return count.error();
  for (const auto& decoder : decoders_) {
    // Representations made by this program wait when they are full, so all is taken.
    if (const auto taken = decoder->push(std::span(bytes_).first(*count)); !taken) return taken.error();
  }
  return *count;
}

}  // namespace scarf
