#include "io/yarp/yarp_packet.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/little_endian.h"
#include "io/base/decimal.h"

namespace scarf {
namespace {

// Takes a word off the front, and the spaces around it.
std::string_view take_word(std::string_view& rest) {
  const auto skip_spaces = [&] { rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size())); };
  skip_spaces();
  const std::string_view word = rest.substr(0, std::min(rest.find(' '), rest.size()));
  rest.remove_prefix(word.size());
  skip_spaces();
  return word;
}

template <class T>
std::optional<T> number_from(std::string_view token) {
  T value = 0;
  const auto [end, failure] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (failure != std::errc() || end != token.data() + token.size()) return std::nullopt;
  return value;
}

// Decimal numbers within parentheses, by turns ticks and words.
bool parse_numbers(std::string_view rest, std::vector<YarpRecord>& records) {
  while (rest.ends_with(' ')) rest.remove_suffix(1);
  if (!rest.starts_with('(') || !rest.ends_with(')') || rest.size() < 2) return false;
  rest = rest.substr(1, rest.size() - 2);
  while (!rest.empty()) {
    const auto ticks = number_from<int64_t>(take_word(rest));
    const auto word = number_from<int64_t>(take_word(rest));
    if (!ticks || !word) return false;
    records.push_back({static_cast<uint32_t>(*word), static_cast<uint32_t>(*ticks)});
  }
  return true;
}

// Bytes within quotes, with escapes.
bool parse_bytes(std::string_view rest, std::string& bytes) {
  if (!rest.starts_with('"')) return false;
  for (size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] == '"') return rest.find_first_not_of(' ', i + 1) == rest.npos;
    if (rest[i] != '\\') {
      bytes.push_back(rest[i]);
      continue;
    }
    if (++i == rest.size()) return false;
    switch (rest[i]) {
      case '0':
        bytes.push_back('\0');
        break;
      case 'n':
        bytes.push_back('\n');
        break;
      case 'r':
        bytes.push_back('\r');
        break;
      case '\\':
      case '"':
        bytes.push_back(rest[i]);
        break;
      default:
        return false;
    }
  }
  return false;
}

uint32_t word_at(const std::string& bytes, size_t index) {
  return load_little_endian<uint32_t>(reinterpret_cast<const uint8_t*>(bytes.data()) + 4 * index);
}

}  // namespace

YarpLine parse_yarp_line(std::string_view line, YarpPacket& packet) {
  packet = {};
  std::string_view rest = line;
  if (!number_from<uint64_t>(take_word(rest))) return YarpLine::broken;
  const auto stamp = microseconds_from_seconds(take_word(rest));
  if (!stamp) return YarpLine::broken;
  packet.stamp = *stamp;
  std::string_view tag = take_word(rest);
  // The second stamp, of a log that has when packets were sent and when they came.
  if (is_decimal(tag)) tag = take_word(rest);
  if (tag != "AE") {
    const bool name = !tag.empty() && std::all_of(tag.begin(), tag.end(),
                                                  [](char c) { return (c >= 'A' && c <= 'Z') || c == '-'; });
    return name ? YarpLine::other : YarpLine::broken;
  }
  if (rest.starts_with('(')) {
    return parse_numbers(rest, packet.records) ? YarpLine::packet : YarpLine::broken;
  }
  const auto duration = number_from<int32_t>(take_word(rest));
  packet.escaped = true;
  if (!duration || *duration < 0 || !parse_bytes(rest, packet.bytes)) return YarpLine::broken;
  packet.duration = *duration;
  return YarpLine::packet;
}

YarpCoding guess_yarp_coding(std::span<const YarpPacket> packets) {
  // Words of places are in order by chance once in n!.
  constexpr size_t kMany = 8;
  size_t timed_records = 0;
  bool plain = true;
  for (const YarpPacket& packet : packets) {
    const size_t words = packet.bytes.size() / 4;
    if (words % 2 != 0) return YarpCoding::plain;
    for (size_t i = 0; i < words; i += 2) {
      const bool place = (word_at(packet.bytes, i + 1) & kYarpFill) == 0;
      const bool time = word_at(packet.bytes, i) >> 31 == 0 &&
                        (i == 0 || word_at(packet.bytes, i) >= word_at(packet.bytes, i - 2));
      if (!place || !time) return YarpCoding::plain;
      plain &= (word_at(packet.bytes, i) & kYarpFill) == 0;
    }
    timed_records += words / 2;
  }
  return timed_records >= kMany || (timed_records > 0 && !plain) ? YarpCoding::timed : YarpCoding::plain;
}

}  // namespace scarf
