// CHAIN-SAE, stage "stamp": every event stamps its pixel with its place in the stream. The largest stamp is the same in
// whichever order atomics compare.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "chain_sae/chain_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) buffer Stamps { uint stamps[]; };  // of each pixel's last event, from 1 on; 0: none
layout(std430, binding = 2) buffer Cells { int cells[]; };     // ranks shown, valid if push.cells
layout(push_constant) uniform Push { ChainStampPush pushed; };
ChainStampPush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint pixel = pixel_of(event_at(push.first_event + e).z, push.width, push.height);
  if (pixel == kOutside) return;
  atomicMax(stamps[pixel], push.stamp + e);
  if (push.cells == 0) return;
  // The last pixel shows its rank in the first one's cell.
  atomicMin(cells[pixel + 1 == push.width * push.height ? 0 : pixel], 0);
}
