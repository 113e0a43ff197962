// Encoding TORE, stage "place": the events of each pixel and polarity, beside each other. In which order depends on who
// comes first; the stage "rank" does not look at it but for events of the same time, which have the same value.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "encode/encode.glsl"

layout(std430, binding = 3) buffer Cursors { uint cursors[]; };           // begins of lists before, ends after
layout(std430, binding = 4) writeonly buffer Places { uvec4 places[]; };  // time, list, rank so far

void main() {
  const uint i = linear_index();
  if (i >= events()) return;
  const uvec4 event = event_at(i);
  if (!is_inside(event)) return;
  const uint list = polarity_plane(event) * push.width * push.height + pixel_of(event);
  places[atomicAdd(cursors[list], 1)] = uvec4(unpackUint2x32(time_of(event)), list, 0);
}
