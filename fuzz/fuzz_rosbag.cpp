// Records of a ROS 1 bag behind its first line.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scarf::check_reader("#ROSBAG V2.0\n", {data, size});
  return 0;
}
