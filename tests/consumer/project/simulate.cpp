// A consumer of the simulated camera alone.
#include <scarf/simulate/simulate.h>

#include "check.h"

int main() {
  const auto simulation = scarf::make_simulation({.sensor = {32, 32}, .duration_s = 0.05});
  CHECK(simulation.ok());
  size_t events = 0;
  while (!(*simulation)->finished()) events += (*simulation)->next().size();
  CHECK(events > 0);
}
