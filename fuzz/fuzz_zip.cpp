// Zip archives of arrays, text and images, and bytes that may be an archive; the first byte chooses.
#include <string>

#include "fuzz/fuzz_reader.h"
#include "fuzz/input_folder.h"
#include "tests/support/archive_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::vector<uint8_t> content(data + 1, data + size);
  const auto bytes_of = [](std::string_view text) { return std::vector<uint8_t>(text.begin(), text.end()); };
  std::vector<uint8_t> archive = content;
  switch (data[0] % 5) {
    case 1:
      archive = scarf::test::zip_file({{"events.txt", content}});
      break;
    case 2:
      archive = scarf::test::zip_file({{"a.npy", content}, {"b.npy", content}});
      break;
    case 3:
      archive = scarf::test::zip_file({{"events.txt", {}}, {"images.txt", content}, {"a.png", content}});
      break;
    case 4:
      archive = scarf::test::zip_file(
          {{"events.txt", {}}, {"images.txt", bytes_of("0.5 a.png\n")}, {"a.png", content}});
      break;
    default:
      archive.insert(archive.begin(), {'P', 'K', 3, 4});
  }
  static const scarf::InputFolder folder;
  const std::string file = folder.put("archive", archive);
  scarf::check_path(file);
  scarf::read_frames(scarf::open_frames(file));
  return 0;
}
