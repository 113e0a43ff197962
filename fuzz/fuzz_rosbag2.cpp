// SQLite databases of ROS 2.
#include "fuzz/fuzz_reader.h"
#include "fuzz/input_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const scarf::InputFolder folder;
  const std::string file = folder.put("bag.db3", {data, size});
  scarf::check_path(file);
  const auto read = [&](size_t batch) { return scarf::read_triggers(scarf::open_triggers(file), batch); };
  scarf::require(read(1024) == read(3));
  return 0;
}
