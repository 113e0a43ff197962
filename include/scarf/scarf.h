// All public headers of the parts of scarf that are there.
#pragma once

#include "scarf/core/encoding.h"
#include "scarf/core/event.h"
#include "scarf/core/filter.h"
#include "scarf/core/image.h"
#include "scarf/core/parameters.h"
#include "scarf/core/patch_grid.h"
#include "scarf/core/patch_state.h"
#include "scarf/core/pending.h"
#include "scarf/core/read_report.h"
#include "scarf/core/representation.h"
#include "scarf/core/result.h"
#include "scarf/version.h"
#if __has_include("scarf/device/context.h")
#include "scarf/device/context.h"
#include "scarf/device/decoder.h"
#include "scarf/device/encoder.h"
#include "scarf/device/group.h"
#include "scarf/device/replay.h"
#include "scarf/device/stream.h"
#include "scarf/device/tuning.h"
#endif
#if __has_include("scarf/reference/reference.h")
#include "scarf/reference/reference.h"
#endif
#if __has_include("scarf/io/recordings.h")
#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"
#include "scarf/io/words.h"
#endif
#if __has_include("scarf/digest/digest.h")
#include "scarf/digest/digest.h"
#endif
#if __has_include("scarf/simulate/simulate.h")
#include "scarf/simulate/simulate.h"
#endif
