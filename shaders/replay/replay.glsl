// What the stages of the replay share. A group of events, x | y << 16 each and all on the sensor, is cut into chunks;
// chunks[push.chunks].begin is the number of events. Include it after the local size is declared.
#include "common/invocation.glsl"
#include "common/views.glsl"

WORDS_VIEW(0, EventsView, events)
WORDS_VIEW(1, ChunksView, chunks)  // two words each, see ReplayChunk
layout(push_constant) uniform Push { ReplayPush pushed; };
ReplayPush push = pushed;

uint event_at(uint e) { return VIEW_WORD(events, e); }
uint chunk_begin(uint chunk) { return VIEW_WORD(chunks, 2 * chunk); }
uint chunk_interval(uint chunk) { return VIEW_WORD(chunks, 2 * chunk + 1); }

// The patch in whose cell an event is: column | row << 16; kReplayNone if there is none.
uint owner_of(uint xy) {
  // Differences below zero wrap to large numbers, and stay beyond every grid when divided by a cell.
  const uint i = uint(int(xy & 0xFFFF) - push.origin_x) / push.cell_x;
  const uint j = uint(int(xy >> 16) - push.origin_y) / push.cell_y;
  return i < push.grid_x && j < push.grid_y ? i | j << 16 : kReplayNone;
}
