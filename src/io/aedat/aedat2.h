// AEDAT 1 and 2, of jAER and v2e: records of an address and a time, both big-endian. What the bits of an
// address mean is a matter of the chip.
// Sources: iniVation, "AEDAT 2.0"; SensorsINI/jaer (DVS128.java, Davis346BaseCamera.java, DVS640.java);
// SensorsINI/v2e (aedat2_output.py); inivation/libcaer (dvs128.c).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "io/base/byte_reader.h"
#include "scarf/core/event.h"
#include "scarf/core/result.h"
#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"

namespace scarf::aedat2 {

/// Where an address has its fields. Columns count from the right, rows from the bottom.
struct Layout {
  int x_shift = 0;
  uint32_t x_mask = 0;
  int y_shift = 0;
  uint32_t y_mask = 0;
  int p_shift = 0;
  uint32_t on = 1;         ///< the polarity bit of a pixel that became brighter
  uint32_t samples = 0;    ///< any of these bits: no event but a sample of a frame or of the IMU, or a mark
  uint32_t triggers = 0;   ///< else any of these: an edge of the external signal
  uint32_t undefined = 0;  ///< else any of these: nothing that the format defines
  uint32_t falling = 0;    ///< the lower three bits of a trigger whose edge falls; 0: no trigger says
};

struct Chip {
  Layout layout;
  SensorSize sensor;
};

/// Takes the header off the input. `sensor`: ReadOptions::sensor, which also says what the addresses mean if
/// the header names no chip that is known. Errors: io; bad_input, naming what to do.
Result<Chip> read_header(ByteReader& input, std::optional<SensorSize> sensor);
/// The same for AEDAT 1, which is of the DVS128.
Result<Chip> read_header_of_version_1(ByteReader& input, std::optional<SensorSize> sensor);

/// The clock of 32 bits with a sign, unwrapped. A step back of more than 2^30 us is a wrap, a smaller one a
/// back-step (as after a reset); a step forward that is as large is one back across the last wrap.
class Clock {
 public:
  int64_t unwrap(int32_t t) {
    const int64_t step = int64_t{t} - previous_;
    if (step < -kWrap) {
      turns_ += kTurn;
    } else if (step > kTurn - kWrap && turns_ > 0) {
      turns_ -= kTurn;
    }
    previous_ = t;
    return turns_ + t;
  }

 private:
  static constexpr int64_t kTurn = int64_t{1} << 32;
  static constexpr int64_t kWrap = int64_t{1} << 30;

  int64_t turns_ = 0;  // times 2^32
  int32_t previous_ = std::numeric_limits<int32_t>::min();
};

/// What a record is. Times of samples are not looked at, so that the clock is the same for events and
/// triggers.
enum class Record { event, trigger, sample, undefined };

inline Record kind_of(const Layout& layout, uint32_t address) {
  if ((address & (layout.samples | layout.triggers | layout.undefined)) == 0) [[likely]]
    return Record::event;
  if ((address & layout.samples) != 0) return Record::sample;
  return (address & layout.triggers) != 0 ? Record::trigger : Record::undefined;
}

/// All but a falling edge counts as one that rises: a pulse, and what older files do not tell apart.
inline Trigger trigger_of(const Layout& layout, uint32_t address, int64_t t) {
  const bool falls = layout.falling != 0 && (address & 7) == layout.falling;
  return {t, 0, static_cast<uint8_t>(falls ? 0 : 1)};
}

}  // namespace scarf::aedat2
