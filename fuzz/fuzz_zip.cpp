// Zip archives of arrays, text and images, and bytes that may be an archive; the first byte chooses.
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "fuzz_reader.h"
#include "scarf/frames.h"
#include "tests/support/archive_bytes.h"

namespace {

// libzip needs a file: one without a name, in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const uint8_t> bytes) : fd_(memfd_create("fuzz", 0)) {
    scarf::require(write(fd_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  ~MemoryFile() { close(fd_); }
  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

std::vector<scarf::Event> read_events(const std::string& path, size_t batch) {
  std::vector<scarf::Event> events;
  auto source = scarf::open_events(path);
  if (!source) return events;
  std::vector<scarf::Event> buffer(batch);
  for (;;) {
    const auto count = (*source)->read(buffer);
    if (!count || *count == 0) return events;
    events.insert(events.end(), buffer.begin(), buffer.begin() + static_cast<ptrdiff_t>(*count));
  }
}

void read_frames(const std::string& path) {
  auto source = scarf::open_frames(path);
  if (!source) return;
  for (;;) {
    const auto frame = (*source)->read();
    if (!frame || !*frame) return;
  }
}

}  // namespace

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
  const MemoryFile file(archive);
  scarf::require(read_events(file.path(), 1024) == read_events(file.path(), 3));
  read_frames(file.path());
  return 0;
}
