// What consumers share: the first thing that is not so ends them.
#pragma once

#include <cstdlib>
#include <iostream>

inline void check(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "not so: " << what << "\n";
  std::exit(1);
}

#define CHECK(condition) check(condition, #condition)
