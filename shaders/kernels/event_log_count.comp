// Event log, stage "count": how many events of each run are copied. The words for the runs have a word in front of them,
// the number of events that are there already, and one behind them: their prefix sum says where each run goes, and how
// many events there are in the end.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "kernels/event_log_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "kernels/event_log.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) writeonly buffer Places { uint places[]; };

void main() {
  const uint run = linear_index();
  const uint runs = (push.events + kLogRun - 1) / kLogRun;
  if (run >= runs) return;
  const uint begin = run * kLogRun;
  const uint end = min(begin + kLogRun, events_in_buffer());
  uint count = 0;
  // Trips: at most kLogRun.
  for (uint i = begin; i < end; ++i) count += is_kept(push.first + i) ? 1 : 0;
  places[run + 1] = count;
  if (run == 0) {
    places[0] = kKeep == kKeepInside ? log_length : 0;
    places[runs + 1] = 0;
  }
}
