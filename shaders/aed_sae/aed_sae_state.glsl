// What AED-SAE knows of its list, and whether an event is too old for it. Needs 64-bit integers.
struct AedState {
  uint start;            // place in the log of the first event since the last clear
  uint first_violation;  // of the submission: place of the first event older than the front of the list
  uint cleared;          // 1: the submission has cleared the list
  uint next;             // clears: the next event to be looked at
  uint front;            // clears: place of the first event of the list, or of one that is too old by now
  uint padding;
  int64_t t_max;         // the largest time since the last clear
};

const uint kNoViolation = 0xFFFFFFFFu;
const int64_t kNeverFired = int64_t(0x8000000000000000ul);

// Microseconds may differ by more than an int64_t holds.
bool is_too_old(int64_t t, int64_t now, uint window) { return t < now && uint64_t(now) - uint64_t(t) > window; }
