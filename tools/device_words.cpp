#include "tools/device_words.h"

#include <utility>

namespace scarf::tools {

void add_decode_option(CLI::App& app, bool& on_device) {
  app.add_option_function<std::string>(
         "--decode", [&on_device](const std::string& word) { on_device = word == "device"; },
         "Where EVT2 and EVT3 words become events: cpu (default) or device; never changes a result")
      ->check(CLI::IsMember({"cpu", "device"}))
      ->group("Work");
}

Result<DeviceWords> DeviceWords::open(const StreamOptions& options, std::span<Representation* const> to) {
  const ReadOptions& read = options.read;
  if (read.time_policy != TimePolicy::keep || read.out_of_sensor != OutOfSensor::drop ||
      read.time_shift != TimeShift::none || read.strict) {
    return Error{
        ErrorCode::illegal_parameter,
        "a device decodes words as they are; leave out --time-policy, --out-of-sensor, --time-shift and "
        "--strict, or leave out --decode device"};
  }
  DeviceWords words;
  auto source = open_words(options.file, read);
  if (!source) return source.error();
  words.source_ = *std::move(source);
  const auto format = words.source_->format() == "evt2" ? CameraWords::evt2 : CameraWords::evt3;
  for (Representation* r : to) {
    auto* const on_device = dynamic_cast<GpuRepresentation*>(r);
    if (on_device == nullptr) {
      return Error{ErrorCode::illegal_parameter,
                   "--decode device needs a device for everything that is shown; leave it out, or leave out "
                   "--cpu and --compare-window"};
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

}  // namespace scarf::tools
