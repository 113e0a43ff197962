// A consumer of the device library by that name.
#include <scarf/device/context.h>
#include <scarf/device/stream.h>

#include "check.h"

int main() {
  const auto context = scarf::GpuContext::create();
  CHECK(context.ok());
  const auto geometry = scarf::make_geometry(scarf::Preset::light, {64, 64});
  const auto stream = scarf::make_gpu_scarf(*context, *geometry);
  const scarf::Event event{.t = 1, .x = 2, .y = 3, .p = 1};
  CHECK((*stream)->push({&event, 1}).ok());
  const auto counts = (*stream)->count_image().wait();
  CHECK(counts->at(2, 3) == 1);
}
