// The formats, each defined beside its reader.
#pragma once

#include "io/format.h"

namespace scarf {

extern const Format kDatFormat;
extern const Format kEvt2Format;
extern const Format kEvt21Format;
extern const Format kEvt3Format;
extern const Format kMetavisionHdf5Format;
extern const Format kMvsecFormat;
extern const Format kM3edFormat;
extern const Format kDsecFormat;
extern const Format kRvtFormat;
extern const Format kEventUtilsFormat;
extern const Format kHdf5Format;
extern const Format kEvt4Format;
extern const Format kTextFormat;

}  // namespace scarf
