// A consumer of the readers and writers alone.
#include <scarf/io/recordings.h>

#include <array>

#include "check.h"

int main() {
  const std::array<scarf::Event, 2> events = {
      {{.t = 1, .x = 2, .y = 3, .p = 1}, {.t = 5, .x = 4, .y = 5, .p = 0}}};
  const auto sink = scarf::create_events("two.raw", "evt3", {64, 64}, {.overwrite = true});
  CHECK(sink.ok());
  CHECK((*sink)->write(events).ok());
  CHECK((*sink)->finish().ok());

  const auto source = scarf::open_events("two.raw");
  CHECK(source.ok());
  CHECK((*source)->format() == "evt3");
  std::array<scarf::Event, 4> read;
  const auto count = (*source)->read(read);
  CHECK(count.ok() && *count == 2);
  CHECK(read[0] == events[0] && read[1] == events[1]);
}
