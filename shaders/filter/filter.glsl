// What the filters share: one invocation per tile walks a part of the tile's list of events in their order.
// Events that pass are copied to their places in a buffer full of events outside the sensor, which no representation
// takes: so it has as many events as before, and the host knows how many.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/events.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) readonly buffer Begins { uint begins[]; };         // see tile_lists.h
layout(std430, binding = 2) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 3) buffer Last { int64_t last[]; };                   // times relative to the first event
layout(std430, binding = 4) writeonly buffer Filtered { uvec4 filtered[]; };   // outside the sensor before
layout(std430, binding = 5) buffer Report { uint report[]; };
layout(push_constant) uniform Push { FilterPush pushed; };
FilterPush push = pushed;

const int64_t kNever = int64_t(0x8000000080000000ul);  // kFilterNever twice

uint passed = 0;
uint rejected = 0;
uint newest = 0;

int64_t time_of(uvec4 event) {
  return int64_t(packUint2x32(event.xy) - packUint2x32(uvec2(push.t_first_low, push.t_first_high)));
}

void decide(uint e, uvec4 event, bool passes) {
  if (passes) {
    ++passed;
    newest = e + 1;
    filtered[e] = event;
  } else {
    ++rejected;
  }
}

// Sums and largest numbers do not depend on which tile comes first.
void add_to_report() {
  if (passed != 0) {
    atomicAdd(report[kFilterPassed], passed);
    atomicMax(report[kFilterNewest], newest);
  }
  if (rejected != 0) atomicAdd(report[kFilterRejected], rejected);
}
