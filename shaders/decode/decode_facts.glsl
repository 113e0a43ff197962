// Joins what the host wants to know of events; see DecodeFacts.
const int64_t kLargestTime = int64_t(0x7FFFFFFFFFFFFFFFul);

DecodeFacts no_events() { return DecodeFacts(0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, kLargestTime, -1); }

// First a, then b.
DecodeFacts join_facts(DecodeFacts a, DecodeFacts b) {
  DecodeFacts both = a;
  both.inside += b.inside;
  both.outside += b.outside;
  both.unknown += b.unknown;
  both.back_steps += b.back_steps;
  both.gaps += b.gaps;
  both.largest_step = max(a.largest_step, b.largest_step);
  both.jumps += b.jumps;
  if (b.first >= 0) {
    if (a.first < 0) both.first = b.first;
    if (b.first < a.last) {
      ++both.back_steps;
      both.largest_step = max(both.largest_step, a.last - b.first);
    }
    const int64_t forward = a.last >= 0 ? b.first - a.last : 0;
    if (forward > kDecodeLongestStep) {
      ++both.jumps;
      if (forward > both.largest_jump) {
        both.largest_jump = forward;
        both.largest_jump_from = a.last;
      }
    }
    if (b.largest_jump > both.largest_jump) {
      both.largest_jump = b.largest_jump;
      both.largest_jump_from = b.largest_jump_from;
    }
    both.last = b.last;
  }
  if (b.first_inside >= 0) {
    if (a.first_inside < 0) both.first_inside = b.first_inside;
    both.last_inside = b.last_inside;
  }
  both.smallest = min(a.smallest, b.smallest);
  both.largest = max(a.largest, b.largest);
  return both;
}
