#include "io/prophesee_header.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "io/decimal.h"
#include "io/sensor_size.h"

namespace scarf {
namespace {

constexpr size_t kMaxLine = 4096;

constexpr std::string_view kEvt2 = "evt2";
constexpr std::string_view kEvt3 = "evt3";

struct System {
  int32_t id;
  std::string_view format;  // if the header does not say
  SensorSize sensor;
};

constexpr SensorSize kVga{640, 480};
constexpr SensorSize kHd{1280, 720};
constexpr SensorSize kGenX320{320, 320};

// Cameras whose files may say no more than their system_ID.
constexpr System kSystems[] = {
    {21, kEvt2, kVga},     {23, kEvt2, kVga}, {25, kEvt2, kVga}, {28, kEvt2, kVga}, {29, kEvt2, kVga},
    {33, kEvt2, kVga},     {34, kEvt2, kVga}, {35, kEvt2, kVga}, {41, kEvt2, kVga}, {26, kEvt2, kHd},
    {31, kEvt2, kHd},      {39, kEvt2, kHd},  {40, kEvt3, kVga}, {30, kEvt3, kHd},  {46, kEvt3, kHd},
    {48, kEvt3, kHd},      {49, kEvt3, kHd},  {50, kEvt3, kHd},  {53, kEvt3, kHd},  {59, kEvt3, kGenX320},
    {64, kEvt3, kGenX320},
};

// Set in the system_ID of some evaluation kits; the camera is the one without it.
constexpr int64_t kEvkProxyFlag = 0x80;

const System* find_system(std::string_view id) {
  const auto value = integer_from(id);
  if (!value) return nullptr;
  const auto* const found = std::find_if(std::begin(kSystems), std::end(kSystems),
                                         [&](const System& s) { return s.id == (*value & ~kEvkProxyFlag); });
  return found == std::end(kSystems) ? nullptr : found;
}

// Takes the part of `rest` before the separator off its front, and the separator with it.
std::string_view take(std::string_view& rest, char separator) {
  const std::string_view part = rest.substr(0, rest.find(separator));
  rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  return part;
}

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

Result<SensorSize> size_from(std::string_view key, std::string_view width, std::string_view height) {
  const auto w = integer_from(width);
  const auto h = integer_from(height);
  if (!w || !h) return bad(text("the header's ", key, " '", width, "x", height, "' is not WIDTHxHEIGHT"));
  return checked_sensor(*w, *h, text("the header's ", key));
}

// The keys that matter, as they stand.
struct Keys {
  std::string format, evt, geometry, system_id;
  bool dat = false;  // keys that only DAT files have

  void set(std::string_view key, std::string_view value) {
    if (key == "format") format = value;
    if (key == "evt") evt = value;
    if (key == "geometry") geometry = value;
    if (key == "system_ID") system_id = value;
    if (key == "Data" || key == "Version" || key == "Width" || key == "Height") dat = true;
  }
};

Result<std::string_view> format_from(std::string_view name) {
  if (name == "EVT2" || name == "2.0") return kEvt2;
  if (name == "EVT3" || name == "3.0") return kEvt3;
  return bad(text("the header names the format '", name, "', which is not supported; EVT2 and EVT3 are"));
}

Result<PropheseeHeader> interpret(const Keys& keys) {
  PropheseeHeader header;
  std::string_view options = keys.format;
  const std::string_view name = take(options, ';');
  if (!name.empty() || !keys.evt.empty()) {
    const auto format = format_from(name.empty() ? keys.evt : name);
    if (!format) return format.error();
    header.format = *format;
  } else if (keys.dat) {
    return bad("this is a Prophesee DAT file, which is not supported yet; convert it to RAW");
  }

  std::string_view width, height;
  while (!options.empty()) {
    std::string_view value = take(options, ';');
    const std::string_view key = take(value, '=');
    if (key == "width") width = value;
    if (key == "height") height = value;
  }
  if (!width.empty() || !height.empty()) {
    const auto size = size_from("format", width, height);
    if (!size) return size.error();
    header.sensor = *size;
  }
  if (!keys.geometry.empty()) {
    std::string_view geometry_height = keys.geometry;
    const std::string_view geometry_width = take(geometry_height, 'x');
    const auto size = size_from("geometry", geometry_width, geometry_height);
    if (!size) return size.error();
    if (header.sensor && *header.sensor != *size) {
      return bad(text("the header contradicts itself: its format says ", size_text(*header.sensor),
                      ", its geometry ", size_text(*size), "; correct one of them"));
    }
    header.sensor = *size;
  }
  if (const System* system = find_system(keys.system_id)) {
    if (header.format.empty()) header.format = system->format;
    if (!header.sensor) header.sensor = system->sensor;
  }
  return header;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r';
}

// Length of the header line, with its newline, that `input` stands at; 0 if it stands behind the header.
// Binary words may begin like a header line by chance, but do not go on like text.
Result<size_t> line_length(ByteReader& input) {
  if (const auto filled = input.fill(2); !filled) return filled.error();
  for (size_t seen = 2;;) {
    const auto bytes = input.available();
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kMaxLine));
    if (!all.starts_with("% ")) return size_t{0};
    const size_t newline = all.find('\n');
    const std::string_view line = all.substr(0, newline);
    if (std::any_of(line.begin(), line.end(), is_control)) return size_t{0};
    if (newline != all.npos) return newline + 1;
    if (all.size() == kMaxLine) return bad(text("a header line is longer than ", kMaxLine, " bytes"));
    if (input.ended()) return size_t{0};
    seen = all.size();
    if (const auto filled = input.fill(seen + 1); !filled) return filled.error();
  }
}

}  // namespace

Result<std::optional<PropheseeHeader>> read_prophesee_header(ByteReader& input) {
  Keys keys;
  bool any = false;
  for (bool end = false; !end;) {
    const auto length = line_length(input);
    if (!length) return length.error();
    if (*length == 0) break;
    std::string_view line(reinterpret_cast<const char*>(input.available().data()), *length);
    line = line.substr(0, line.find_last_not_of("\r\n \t") + 1);
    line.remove_prefix(std::min<size_t>(2, line.size()));
    end = line == "end";
    const std::string_view key = take(line, ' ');
    keys.set(key, line);
    any = true;
    input.skip(*length);
  }
  if (!any) return std::optional<PropheseeHeader>();
  const auto header = interpret(keys);
  if (!header) return header.error();
  return std::optional(*header);
}

std::string prophesee_header_text(std::string_view format, SensorSize sensor) {
  const bool evt2 = format == kEvt2;
  return text("% evt ", evt2 ? "2.0" : "3.0", "\n% format ", evt2 ? "EVT2" : "EVT3",
              ";height=", sensor.height, ";width=", sensor.width, "\n% geometry ", size_text(sensor),
              "\n% end\n");
}

}  // namespace scarf
