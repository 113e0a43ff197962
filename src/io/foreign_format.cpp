#include "io/foreign_format.h"

namespace scarf {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  std::string_view advice;
};

constexpr Magic kMagics[] = {
    {"PK\x03\x04"sv, "looks like a zip archive: unpack it first"},
    {"\x1f\x8b"sv, "looks like gzip: unpack it first"},
    {"BZh"sv, "looks like bzip2: unpack it first"},
    {"\xfd\x37zXZ\0"sv, "looks like xz: unpack it first"},
    {"\x28\xb5\x2f\xfd"sv, "looks like Zstandard: unpack it first"},
    {"7z\xbc\xaf\x27\x1c"sv, "looks like a 7z archive: unpack it first"},
    {"#!AER-DAT4"sv, "AEDAT4 is not supported yet: export it as text"},
    {"#!AER-DAT"sv, "AEDAT before version 4 is not supported: export it as text"},
    {"Event Stream"sv, "Event Stream (.es) is not supported yet: export it as text"},
    {"\x89HDF\r\n\x1a\n"sv, "HDF5 is not supported yet: export it as text or RAW"},
    {"#ROSBAG V"sv, "ROS bags are not supported yet: export the events as text or RAW"},
    {"\x89MCAP0\r\n"sv, "MCAP (ROS 2 bag) is not supported yet: export the events as text or RAW"},
    {"SQLite format 3\0"sv,
     "looks like a SQLite database (ROS 2 bag), not supported yet: export the events as text"},
    {"\x93NUMPY"sv, "NumPy arrays are not supported yet: export them as text"},
    {"\x89PNG"sv, "looks like a PNG image, not events"},
    {"\xff\xd8\xff"sv, "looks like a JPEG image, not events"},
};

std::string_view characters(std::span<const uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::string_view foreign_format(std::span<const uint8_t> bytes) {
  const std::string_view start = characters(bytes);
  for (const Magic& magic : kMagics) {
    if (start.starts_with(magic.bytes)) return magic.advice;
  }
  return {};
}

bool foreign_recording(std::span<const uint8_t> bytes) {
  return characters(bytes).starts_with("#!AER-DAT");
}

}  // namespace scarf
