// CPU twin of the stage that unpacks events.
#pragma once

#include <cstdint>
#include <span>

#include "scarf/core/event.h"
#include "shaders/decode/unpack_layout.h"

namespace scarf::stages {

/// shaders/decode/unpack_events.comp: the events of a part; push.events of them.
void unpack_events(std::span<const uint32_t> packed, std::span<Event> events, const layout::UnpackPush& push);

}  // namespace scarf::stages
