// Small archives, arrays and images, byte by byte.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/little_endian.h"

namespace scarf::test {

inline uint32_t crc32_of(std::span<const uint8_t> bytes) {
  uint32_t crc = 0xFFFFFFFF;
  for (const uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
  }
  return ~crc;
}

/// A zip archive whose members are stored as they are.
inline std::vector<uint8_t> zip_file(
    const std::vector<std::pair<std::string, std::vector<uint8_t>>>& members) {
  std::vector<uint8_t> zip;
  std::vector<uint8_t> directory;
  const auto add = [](std::vector<uint8_t>& to, std::span<const uint8_t> from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const auto& [name, content] : members) {
    const auto place = static_cast<uint32_t>(zip.size());
    const auto size = static_cast<uint32_t>(content.size());
    // What the member and its entry in the directory both say: version, flags, method, time, date, ...
    std::vector<uint8_t> common;
    for (const int word : {20, 0, 0, 0, 0x21}) append_little_endian(common, static_cast<uint16_t>(word));
    append_little_endian(common, crc32_of(content));
    append_little_endian(common, size);
    append_little_endian(common, size);
    append_little_endian(common, static_cast<uint16_t>(name.size()));
    append_little_endian(common, uint16_t{0});

    append_little_endian(zip, uint32_t{0x04034B50});
    add(zip, common);
    add(zip, std::vector<uint8_t>(name.begin(), name.end()));
    add(zip, content);

    append_little_endian(directory, uint32_t{0x02014B50});
    append_little_endian(directory, uint16_t{20});
    add(directory, common);
    for (int i = 0; i < 3; ++i) append_little_endian(directory, uint16_t{0});
    append_little_endian(directory, uint32_t{0});
    append_little_endian(directory, place);
    add(directory, std::vector<uint8_t>(name.begin(), name.end()));
  }
  const auto place = static_cast<uint32_t>(zip.size());
  add(zip, directory);
  append_little_endian(zip, uint32_t{0x06054B50});
  append_little_endian(zip, uint32_t{0});
  for (int i = 0; i < 2; ++i) append_little_endian(zip, static_cast<uint16_t>(members.size()));
  append_little_endian(zip, static_cast<uint32_t>(directory.size()));
  append_little_endian(zip, place);
  append_little_endian(zip, uint16_t{0});
  return zip;
}

/// A grey PNG image of one byte per pixel, not compressed. At most 65,535 bytes with one more per row.
inline std::vector<uint8_t> png_file(uint32_t width, uint32_t height, const std::vector<uint8_t>& pixels) {
  std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  const auto append_big_endian = [](std::vector<uint8_t>& to, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<uint8_t>(value >> shift));
  };
  const auto add_chunk = [&](std::string_view name, const std::vector<uint8_t>& content) {
    append_big_endian(png, static_cast<uint32_t>(content.size()));
    std::vector<uint8_t> checked(name.begin(), name.end());
    checked.insert(checked.end(), content.begin(), content.end());
    png.insert(png.end(), checked.begin(), checked.end());
    append_big_endian(png, crc32_of(checked));
  };
  std::vector<uint8_t> header;
  append_big_endian(header, width);
  append_big_endian(header, height);
  append_little_endian(header, uint32_t{8});
  header.push_back(0);
  add_chunk("IHDR", header);
  // Rows behind the number of their filter, in one stored block of zlib.
  std::vector<uint8_t> rows(size_t{height} * (width + 1));
  for (size_t y = 0; y < height; ++y) {
    std::copy_n(pixels.begin() + static_cast<ptrdiff_t>(y * width), width,
                rows.begin() + static_cast<ptrdiff_t>(y * (width + 1) + 1));
  }
  std::vector<uint8_t> data = {0x78, 0x01, 0x01};
  append_little_endian(data, static_cast<uint16_t>(rows.size()));
  append_little_endian(data, static_cast<uint16_t>(~rows.size()));
  data.insert(data.end(), rows.begin(), rows.end());
  uint32_t sum = 1;
  uint32_t sum_of_sums = 0;
  for (const uint8_t byte : rows) {
    sum = (sum + byte) % 65'521;
    sum_of_sums = (sum_of_sums + sum) % 65'521;
  }
  append_big_endian(data, sum_of_sums << 16 | sum);
  add_chunk("IDAT", data);
  add_chunk("IEND", {});
  return png;
}

/// A NumPy array: the text of its type, such as "'<i8'", and of its shape; version 1 or 2 of the format.
inline std::vector<uint8_t> npy_file(const std::string& type, const std::string& shape,
                                     const std::vector<uint8_t>& content, int version = 1,
                                     const std::string& order = "False") {
  const std::string header =
      "{'descr': " + type + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
  std::vector<uint8_t> bytes = {0x93, 'N', 'U', 'M', 'P', 'Y', static_cast<uint8_t>(version), 0};
  append_little_endian(bytes, static_cast<uint16_t>(header.size()));
  if (version > 1) append_little_endian(bytes, uint16_t{0});
  bytes.insert(bytes.end(), header.begin(), header.end());
  bytes.insert(bytes.end(), content.begin(), content.end());
  return bytes;
}

}  // namespace scarf::test
