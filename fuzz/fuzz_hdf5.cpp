// Whole HDF5 files, with one of the options that layouts need, and their frames.
#include <array>

#include "fuzz/fuzz_reader.h"
#include "fuzz/input_folder.h"

// libhdf5 forgets memory of files that it refuses.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT: the sanitizer's name
  return "leak:libhdf5";
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const scarf::InputFolder folder;
  const std::string file = folder.put("events.h5", {data, size});
  std::array<scarf::ReadOptions, 3> options;
  options[1].stream = "left";
  options[2].columns = "txyp";
  options[2].time_unit = "us";
  scarf::check_path(file, options[size % options.size()]);
  scarf::read_frames(scarf::open_frames(file, options[1]));
  return 0;
}
