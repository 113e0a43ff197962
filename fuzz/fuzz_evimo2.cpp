// The three arrays of EV-IMO2; the first three bytes say how many of the others belong to each.
#include "fuzz/fuzz_reader.h"
#include "fuzz/input_folder.h"
#include "tests/support/archive_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 3) return 0;
  static const scarf::InputFolder folder;
  std::span<const uint8_t> rest(data + 3, size - 3);
  const auto part = [&](const std::string& file, const std::string& type, const std::string& shape,
                        uint8_t share) {
    const auto bytes = rest.first(rest.size() * share / 255);
    rest = rest.subspan(bytes.size());
    // Mostly behind a good header, sometimes without.
    const std::vector<uint8_t> content(bytes.begin(), bytes.end());
    folder.put(file, share % 8 == 0 ? content : scarf::test::npy_file(type, shape, content));
  };
  part("dataset_events_t.npy", "'<f8'", "(9,)", data[0]);
  part("dataset_events_xy.npy", "'<u2'", "(9, 2)", data[1]);
  part("dataset_events_p.npy", "'|u1'", "(9,)", data[2]);
  scarf::check_path(folder.path());
  return 0;
}
