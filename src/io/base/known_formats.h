// The formats, each defined beside its reader.
#pragma once

#include "io/base/format.h"

namespace scarf {

extern const Format kAedat1Format;
extern const Format kAedat2Format;
extern const Format kAedat3Format;
extern const Format kAedat4Format;
extern const Format kCsvFormat;
extern const Format kDatFormat;
extern const Format kDsecFormat;
extern const Format kEcdFormat;
extern const Format kEventStreamFormat;
extern const Format kEventUtilsFormat;
extern const Format kEvimo2Format;
extern const Format kEvt21Format;
extern const Format kEvt2Format;
extern const Format kEvt3Format;
extern const Format kEvt4Format;
extern const Format kHdf5Format;
extern const Format kM3edFormat;
extern const Format kMcapFormat;
extern const Format kMetavisionHdf5Format;
extern const Format kMvsecFormat;
extern const Format kNmnistFormat;
extern const Format kNpyFormat;
extern const Format kNpzFormat;
extern const Format kRosbag2Format;
extern const Format kRosbagFormat;
extern const Format kRvtFormat;
extern const Format kTextFormat;
extern const Format kYarpFormat;

}  // namespace scarf
