// Whether a packed event lies in the active region of the patch that stores it. Include it after packed_event.glsl and
// push constants that have the margins and the cell.
bool is_active(uint low_word) {
  // Differences below zero wrap to large numbers.
  return packed_x(low_word) - push.margin_lo_x < push.cell_x && packed_y(low_word) - push.margin_lo_y < push.cell_y;
}
