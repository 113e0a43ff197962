// A consumer of the reference alone: no Vulkan.
#include <scarf/reference.h>

#include <iostream>

int main() {
  const auto geometry = scarf::make_geometry(scarf::Preset::light, {64, 64});
  const auto stream = scarf::make_reference_scarf(*geometry);
  const scarf::Event event{.t = 1, .x = 2, .y = 3, .p = 1};
  if (!(*stream)->push({&event, 1})) return 1;
  const auto counts = (*stream)->count_image().wait();
  std::cout << counts->at(2, 3) << "\n";
  return counts->at(2, 3) == 1 ? 0 : 1;
}
