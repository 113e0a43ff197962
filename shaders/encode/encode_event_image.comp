// Encoding of EV-FlowNet, stage "event_image": numbers of events and last times. Sums and largest numbers are the same
// in any order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "encode/encode.glsl"
#define SPAN_BINDING 3
#include "encode/encode_span.glsl"

layout(std430, binding = 4) buffer Numbers { uint numbers[]; };  // two planes of counts, two of weights; zeros before

void main() {
  const uint i = linear_index();
  if (i >= events()) return;
  const uvec4 event = event_at(i);
  if (!is_inside(event)) return;
  const uint64_t length = since_first(last_time());
  // Where all events have the same time, each is the last event.
  uint weight = 1u << kEncodeWeightBits;
  if (length != 0) weight = rounded_weight(since_first(time_of(event)), length);
  const uint area = push.width * push.height;
  const uint value = polarity_plane(event) * area + pixel_of(event);
  atomicAdd(numbers[value], 1);
  atomicMax(numbers[value + 2 * area], weight);
}
