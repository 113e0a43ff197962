// Encodings, stage "span": the smallest and the largest time; first their high words, then, among the events that have
// these, the low words.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "encode/encode.glsl"

layout(std430, binding = 3) buffer Span { uint span[]; };  // zeros before the high words

// What was there at any time is no more than what is there now, so a look at it saves most of the atomics.
void raise(uint word, uint number) {
  if (span[word] < number) atomicMax(span[word], number);
}

void main() {
  const uint i = linear_index();
  if (i >= events()) return;
  const uvec4 event = event_at(i);
  if (!is_inside(event)) return;
  const uvec2 t = unpackUint2x32(time_of(event));
  if (push.mode == 0) {
    raise(kSpanFirstHigh, ~t.y);
    raise(kSpanLastHigh, t.y);
    return;
  }
  if (~t.y == span[kSpanFirstHigh]) raise(kSpanFirstLow, ~t.x);
  if (t.y == span[kSpanLastHigh]) raise(kSpanLastLow, t.x);
}
