// The file behind an EventSink.
#include <utility>

#include "core/text.h"
#include "io/sensor_size.h"
#include "io/writers.h"

namespace scarf {

Result<std::unique_ptr<EventSink>> create_events(const std::string& path, WriteFormat format,
                                                 SensorSize sensor) {
  const auto legal = checked_sensor(sensor.width, sensor.height, text(path, ": the sensor size given"));
  if (!legal) return Error{ErrorCode::illegal_parameter, legal.error().message};
  auto output = path == "-" ? ByteWriter::standard_output() : ByteWriter::create(path);
  if (!output) return output.error();
  switch (format) {
    case WriteFormat::evt2:
      return make_evt2_writer(*std::move(output), sensor);
    case WriteFormat::evt3:
      return make_evt3_writer(*std::move(output), sensor);
    case WriteFormat::text:
      break;
  }
  return make_text_writer(*std::move(output), sensor);
}

}  // namespace scarf
