// The formats, each defined beside its reader.
#pragma once

#include "io/format.h"

namespace scarf {

extern const Format kAedat4Format;
extern const Format kEvt2Format;
extern const Format kEvt3Format;
extern const Format kMcapFormat;
extern const Format kRosbagFormat;
extern const Format kRosbag2Format;
extern const Format kTextFormat;

}  // namespace scarf
