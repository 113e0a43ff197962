// Reader of one NumPy array (.npy).

#include <utility>

#include "io/base/known_formats.h"
#include "io/base/writers.h"
#include "io/numpy/array_source.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "npy";

Result<std::unique_ptr<EventSource>> open_npy(Input input, const ReadOptions& options) {
  const auto header = read_numpy_header(input.bytes);
  if (!header) return header.error();
  auto arrays = columns_of_array(std::move(input.bytes), *header, options);
  if (!arrays) return arrays.error();
  return open_arrays(kName, input.name, *std::move(arrays), options);
}

bool recognise_npy(const Beginning& beginning) {
  return starts_with(beginning.bytes, kNumpyMagic);
}

}  // namespace

const Format kNpyFormat = {.name = kName,
                           .title = "NumPy array (.npy), with named fields or a row per event",
                           .options = kTakesColumns | kTakesTimeUnit,
                           .recognise = recognise_npy,
                           .open = open_npy,
                           .create = create_npy};

}  // namespace scarf
