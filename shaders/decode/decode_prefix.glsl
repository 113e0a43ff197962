// For each lane of a workgroup, everything before it joined. The includer defines JOINED (a type), NOTHING (its
// constant that changes nothing) and JOIN(a, b); it is called by whole workgroups.
shared JOINED lane_values[kDecodeGroup];
shared JOINED row_values[kDecodeGroup / kDecodeRow + 1];

// What is joined of the lanes before this one; `all`: of all lanes.
JOINED joined_before(JOINED mine, out JOINED all) {
  const uint lane = gl_LocalInvocationID.x;
  const uint rows = kDecodeGroup / kDecodeRow;
  lane_values[lane] = mine;
  barrier();
  if (lane < rows) {
    JOINED row = NOTHING;
    // Trips: kDecodeRow. Each value becomes what is before it in its row.
    for (uint i = lane * kDecodeRow; i < (lane + 1) * kDecodeRow; ++i) {
      const JOINED value = lane_values[i];
      lane_values[i] = row;
      row = JOIN(row, value);
    }
    row_values[lane] = row;
  }
  barrier();
  if (lane == 0) {
    JOINED before = NOTHING;
    // Trips: kDecodeGroup / kDecodeRow.
    for (uint i = 0; i < rows; ++i) {
      const JOINED value = row_values[i];
      row_values[i] = before;
      before = JOIN(before, value);
    }
    row_values[rows] = before;
  }
  barrier();
  all = row_values[rows];
  return JOIN(row_values[lane / kDecodeRow], lane_values[lane]);
}

// The part of an array of blocks that a lane of the only workgroup walks.
uint blocks_begin() { return min(gl_LocalInvocationID.x * ((push.blocks + kDecodeGroup - 1) / kDecodeGroup), push.blocks); }
uint blocks_end() { return min(blocks_begin() + (push.blocks + kDecodeGroup - 1) / kDecodeGroup, push.blocks); }
