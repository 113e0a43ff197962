#include "io/foreign_format.h"

namespace scarf {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  std::string_view advice;
};

constexpr Magic kMagics[] = {
    {"\x1f\x8b"sv, "looks like gzip: unpack it first"},
    {"BZh"sv, "looks like bzip2: unpack it first"},
    {"\xfd\x37zXZ\0"sv, "looks like xz: unpack it first"},
    {"\x28\xb5\x2f\xfd"sv, "looks like Zstandard: unpack it first"},
    {"7z\xbc\xaf\x27\x1c"sv, "looks like a 7z archive: unpack it first"},
    {"#!AER-DAT4.0"sv, {}},
    {"#!AER-DAT2"sv,
     "this is AEDAT 2.0 (jAER, v2e), which scarf does not read: convert it to AEDAT4 with iniVation's DV or "
     "to "
     "text, or let v2e write text (--dvs_text)"},
    {"#!AER-DAT"sv,
     "this is AEDAT of another version than 4.0, which scarf does not read: convert it to AEDAT4 with "
     "iniVation's DV, or to text"},
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
