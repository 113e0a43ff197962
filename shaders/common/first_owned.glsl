// Which of the patches that hold an event a lane of a team owns, along an axis.
// First value >= first that is = lane mod team, a power of two.
uint first_owned(uint first, uint lane, uint team) { return first + ((lane - first) & (team - 1)); }
