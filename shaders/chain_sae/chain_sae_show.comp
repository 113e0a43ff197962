// CHAIN-SAE, rule event_driven, stage "show": the ranks are written into the cells from newest to oldest. The oldest
// pixel is left out: its cell keeps what it showed. The last pixel's cell is that of the first one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "chain_sae/chain_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Ranks { int ranks[]; };  // every pixel has one
layout(std430, binding = 1) buffer Cells { int cells[]; };
layout(push_constant) uniform Push { ChainPush pushed; };
ChainPush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel >= push.pixels) return;
  const uint last_pixel = push.pixels - 1;
  const int oldest = int(last_pixel);
  int shown = -1;
  if (pixel == 0 || pixel != last_pixel) {
    const int own = ranks[pixel];
    if (own != oldest) shown = own;
  }
  if (pixel == 0) {
    const int other = ranks[last_pixel];
    if (other != oldest) shown = max(shown, other);  // the older one is written later
  }
  if (shown >= 0) cells[pixel] = shown;
}
