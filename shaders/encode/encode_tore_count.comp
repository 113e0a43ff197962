// Encoding TORE, stage "count": how many events each pixel and polarity has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "encode/encode.glsl"

layout(std430, binding = 3) buffer Cursors { uint cursors[]; };  // per polarity and pixel; zeros before

void main() {
  const uint i = linear_index();
  if (i >= events()) return;
  const uvec4 event = event_at(i);
  if (!is_inside(event)) return;
  atomicAdd(cursors[polarity_plane(event) * push.width * push.height + pixel_of(event)], 1);
}
