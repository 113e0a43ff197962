// The block of an event. Include it after push constants that have the blocks.
uint block_of(uint xy) {
  return (xy >> 16) / push.block_height * push.block_columns + (xy & 0xFFFF) / push.block_width;
}
