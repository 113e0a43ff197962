// Push constants of CHAIN-SAE, shared by the shaders and the host.
#ifndef SCARF_SHADERS_CHAIN_SAE_LAYOUT_H
#define SCARF_SHADERS_CHAIN_SAE_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
#endif

// chain_sae_stamp: one submission of events.
struct ChainStampPush {
  uint first_event;  // index of the first event in the staging buffer
  uint events;
  uint width;
  uint height;
  uint stamp;  // of the first event
  uint cells;  // 1: an event sets the cell of its pixel to the newest rank
};

// The stages of a query and of a renumbering.
struct ChainPush {
  uint pixels;
  uint words;  // of the bit set of stamps; the number of all stamps in use is behind their counts
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#endif
