// EVT2 IMU blocks: a map from the words still to be skipped in front of some words to those behind them, one nibble per
// number. Maps can be joined in any grouping, so that where blocks begin needs no walk from the beginning.
uint skip_behind(uint map, uint skip) { return map >> 4 * skip & 7; }

uint join_skips(uint a, uint b) {
  uint both = 0;
  // Trips: 6.
  for (uint skip = 0; skip <= kDecodeImuSkip; ++skip) both |= skip_behind(b, skip_behind(a, skip)) << 4 * skip;
  return both;
}
