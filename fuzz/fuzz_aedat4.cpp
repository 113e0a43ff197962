// AEDAT4: packets of events, frames and triggers behind a good header, and headers.
#include <string>

#include "core/little_endian.h"
#include "fuzz/fuzz_reader.h"
#include "io/aedat/aedat4.h"

namespace {

// Streams 0, 1 and 2 with events, frames and triggers, not compressed.
std::string header() {
  std::string xml = "<dv><node name=\"outInfo\">";
  for (const char* stream : {"0\"><attr key=\"typeIdentifier\">EVTS", "1\"><attr key=\"typeIdentifier\">FRME",
                             "2\"><attr key=\"typeIdentifier\">TRIG"}) {
    xml +=
        std::string("<node name=\"") + stream +
        "</attr><node name=\"info\"><attr key=\"sizeX\">40</attr><attr key=\"sizeY\">30</attr></node></node>";
  }
  xml += "</node></dv>";
  std::vector<uint8_t> table;
  scarf::append_little_endian(table, uint32_t{20});  // the root is at 20
  for (const char c : std::string_view("IOHE")) table.push_back(static_cast<uint8_t>(c));
  for (const uint16_t entry : {10, 8, 0, 0, 4, 0}) scarf::append_little_endian(table, entry);
  scarf::append_little_endian(table, uint32_t{12});  // its fields are listed at 20 - 12
  scarf::append_little_endian(table, uint32_t{4});   // the XML begins 4 bytes on
  scarf::append_little_endian(table, static_cast<uint32_t>(xml.size()));
  std::vector<uint8_t> size;
  scarf::append_little_endian(size, static_cast<uint32_t>(table.size() + xml.size()));
  return std::string(scarf::aedat4::kMagic) + std::string(size.begin(), size.end()) +
         std::string(table.begin(), table.end()) + xml;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string good = header();
  scarf::check_reader(good, {data, size});
  scarf::check_reader(scarf::aedat4::kMagic, {data, size});
  return 0;
}
