// Encoding TORE, stage "rank": the rank of an event is the number of newer ones in its list. The values of the k newest
// are looked up by age and copied as bits.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "encode/encode.glsl"
#define SPAN_BINDING 3
#include "encode/encode_span.glsl"

layout(std430, binding = 4) readonly buffer Cursors { uint cursors[]; };  // ends of lists
layout(std430, binding = 5) buffer Places { uvec4 places[]; };            // time, list, rank so far
layout(std430, binding = 6) readonly buffer Values { uint values[]; };    // by age
layout(std430, binding = 7) writeonly buffer Tensor { uint tensor[]; };   // bits of floats; that of the oldest before

void main() {
  const uint area = push.width * push.height;
  const uint place = linear_index();
  if (place >= min(events(), cursors[2 * area - 1])) return;  // the last list ends behind the last event inside
  const uvec4 own = places[place];
  const uint64_t t = packUint2x32(own.xy);
  const uint list_begin = own.z == 0 ? 0 : cursors[own.z - 1];
  const uint list_end = cursors[own.z];
  // Lists are walked from their ends, because events mostly come in the order of their times.
  const uint walk_begin = push.begin;
  const uint walk_end = min(push.end, list_end - list_begin);
  uint rank = own.w;
  // Trips: at most push.end - push.begin, which the host chooses by the device's limit.
  for (uint i = walk_begin; i < walk_end && rank < push.planes; ++i) {
    const uint other = list_end - 1 - i;
    const uint64_t other_t = packUint2x32(places[other].xy);
    if (other_t > t || (other_t == t && other > place)) ++rank;
  }
  places[place].w = rank;
  // This part ends the walk, if an earlier one has not.
  if (walk_end < list_end - list_begin || walk_begin >= list_end - list_begin || rank >= push.planes) return;
  const uint64_t age = min(last_time() - t, uint64_t(kEncodeToreOldest));
  const uint plane = own.z / area * push.planes + rank;
  tensor[plane * area + own.z % area] = values[uint(age)];
}
