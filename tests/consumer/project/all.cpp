// A consumer of everything, through one header: a simulated recording on the device is that on the reference.
#include <scarf/scarf.h>

#include <string>

#include "check.h"

int main() {
  CHECK(scarf::version_text() == std::string(EXPECTED_VERSION));
  const auto geometry = scarf::make_geometry(scarf::Preset::light, {64, 64});
  const auto context = scarf::GpuContext::create();
  CHECK(context.ok());
  const auto device = scarf::make_gpu_scarf(*context, *geometry);
  const auto reference = scarf::make_reference_scarf(*geometry);
  const auto simulation = scarf::make_simulation({.sensor = {64, 64}, .duration_s = 0.05});
  while (!(*simulation)->finished()) {
    const auto events = (*simulation)->next();
    CHECK((*device)->push(events).ok());
    CHECK((*reference)->push(events).ok());
  }
  const auto ours = (*device)->u8_image().wait();
  const auto theirs = (*reference)->u8_image().wait();
  CHECK(scarf::image_digest(*ours) == scarf::image_digest(*theirs));
  CHECK(!scarf::formats().empty());
}
