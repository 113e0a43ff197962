// The writers behind create_events, one per format.
#pragma once

#include <memory>

#include "io/byte_writer.h"
#include "scarf/io.h"

namespace scarf {

std::unique_ptr<EventSink> make_evt2_writer(ByteWriter output, SensorSize sensor);
std::unique_ptr<EventSink> make_evt3_writer(ByteWriter output, SensorSize sensor);
std::unique_ptr<EventSink> make_text_writer(ByteWriter output, SensorSize sensor);

}  // namespace scarf
