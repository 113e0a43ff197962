// The brightness tables of the representations: made once on the host, in double precision, so that no
// implementation does floating-point arithmetic on pixels.
#pragma once

#include <cstdint>

#include "scarf/core/image.h"

namespace scarf {

/// The age of a pixel of EROS and TOS is the number of events in its window since its own last event.
inline constexpr uint16_t kOldest = 65'534;  ///< where the age saturates
inline constexpr uint16_t kNeverFiredAge = 65'535;

/// Brightness by age, 65,536 entries; 0 at kNeverFiredAge. `kernel` is odd.
Levels eros_table(int32_t kernel, double decay);
Levels tos_table(int32_t kernel, double decay);

/// Microseconds per entry of exponential_table, tau in microseconds.
int64_t exponential_step(int64_t tau);
/// Time surface with exponential decay: the entry of an age below 8 * tau is age / step, that of all other
/// ages is the last one, which is 0.
Levels exponential_table(int64_t tau);
/// Time surface with linear decay: the entry of an age is min(age, tau). tau + 1 entries.
Levels linear_table(int64_t tau);

/// Chained surface: brightness by rank, 0 = newest; the entry `pixels` is 0 and stands for no rank.
Levels chain_table(int64_t pixels, bool linear);

}  // namespace scarf
