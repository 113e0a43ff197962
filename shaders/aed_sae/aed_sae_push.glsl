// The log, its runs and the state of AED-SAE, as the stages of a push see them.
#include "aed_sae/aed_sae_state.glsl"
layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Length { uint log_length; };
layout(std430, binding = 2) readonly buffer Places { uint places[]; };   // [1]: the length before the submission
layout(std430, binding = 3) buffer StateBuffer { AedState state; };
layout(push_constant) uniform Push { AedPush pushed; };
AedPush push = pushed;

int64_t time_of(uint i) { return packInt2x32(ivec2(events[i].xy)); }
uint old_length() { return places[1]; }

// The first run of the range.
uint first_run() {
  if (push.range == kAedAll) return 0;
  return (push.range == kAedNew ? old_length() : state.start) / kAedRun;
}
bool range_is_empty() { return push.range == kAedAfterClear && state.cleared == 0; }
