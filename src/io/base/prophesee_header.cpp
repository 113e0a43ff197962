#include "io/base/prophesee_header.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "io/base/decimal.h"
#include "io/base/sensor_size.h"

namespace scarf {
namespace {

constexpr size_t kMaxLine = 4096;
constexpr size_t kMaxHeader = size_t{1} << 20;

// What says how the file is to be read. The rest is about the camera.
constexpr std::string_view kReadingKeys[] = {"evt",  "format",  "geometry", "endianness", "end",
                                             "Data", "Version", "Width",    "Height"};

bool is_reading_key(std::string_view key) {
  return std::find(std::begin(kReadingKeys), std::end(kReadingKeys), key) != std::end(kReadingKeys);
}

constexpr std::string_view kEvt2 = "evt2";
constexpr std::string_view kEvt3 = "evt3";
constexpr std::string_view kDat = "dat";

struct WordFormat {
  std::string_view name;     // of formats()
  std::string_view key;      // in `format`
  std::string_view version;  // in `evt`
};
constexpr WordFormat kWordFormats[] = {
    {kEvt2, "EVT2", "2.0"}, {"evt21", "EVT21", "2.1"}, {kEvt3, "EVT3", "3.0"}, {"evt4", "EVT4", "4.0"}};

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
  std::string format, evt, geometry, system_id, endianness, camera_integrator, plugin_integrator;
  std::string version, width, height;
  bool dat = false;    // keys that only DAT files have
  bool index = false;  // keys that only indexes of recordings have

  void set(std::string_view key, std::string_view value) {
    if (key == "format") format = value;
    if (key == "evt") evt = value;
    if (key == "geometry") geometry = value;
    if (key == "system_ID") system_id = value;
    if (key == "endianness") endianness = value;
    if (key == "integrator_name" || key == "camera_integrator_name") camera_integrator = value;
    if (key == "plugin_integrator_name") plugin_integrator = value;
    if (key == "Version") version = value;
    if (key == "Width") width = value;
    if (key == "Height") height = value;
    index |= key == "index_version" || key == "bookmark_period_us";
    dat |= key == "Data" || key == "Version" || key == "Width" || key == "Height";
  }
};

Result<std::string_view> format_from(std::string_view name) {
  for (const WordFormat& f : kWordFormats) {
    if (name == f.key || name == f.version) return f.name;
  }
  return bad(text("the header names the format '", name,
                  "', which is not supported; EVT2, EVT21, EVT3 and EVT4 are"));
}

// The byte order of EVT2.1: `said`, or OpenEB's rule that Prophesee's own cameras before system 55 (Saphir)
// have the legacy one.
Result<evt21::ByteOrder> byte_order_from(std::string_view said, const Keys& keys) {
  constexpr int64_t kSaphir = 55;
  if (said == "little") return evt21::ByteOrder::little;
  if (said == "legacy") return evt21::ByteOrder::legacy;
  if (!said.empty()) {
    return bad(text("the header's endianness '", said, "' is unknown; 'little' and 'legacy' are known"));
  }
  const int64_t system = integer_from(keys.system_id).value_or(0) & ~kEvkProxyFlag;
  const bool by_prophesee = keys.camera_integrator == "Prophesee" && keys.plugin_integrator == "Prophesee";
  return by_prophesee && system > 0 && system < kSaphir ? evt21::ByteOrder::legacy : evt21::ByteOrder::little;
}

// Takes over a size that the header gives under `key`; it may give several, which must agree.
Result<void> agree_on_size(PropheseeHeader& header, std::string_view key, std::string_view width,
                           std::string_view height) {
  const auto size = size_from(key, width, height);
  if (!size) return size.error();
  if (header.sensor && *header.sensor != *size) {
    return bad(text("the header contradicts itself: it says ", size_text(*header.sensor), ", and as ", key,
                    " ", size_text(*size), "; correct one of them"));
  }
  header.sensor = *size;
  return {};
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
    header.format = kDat;
  }

  std::string_view width, height, endianness = keys.endianness;
  while (!options.empty()) {
    std::string_view value = take(options, ';');
    const std::string_view key = take(value, '=');
    if (key == "width") width = value;
    if (key == "height") height = value;
    if (key == "endianness") endianness = value;
  }
  const auto byte_order = byte_order_from(endianness, keys);
  if (!byte_order) return byte_order.error();
  header.byte_order = *byte_order;
  if (!width.empty() || !height.empty()) {
    if (auto r = agree_on_size(header, "format", width, height); !r) return r.error();
  }
  if (!keys.geometry.empty()) {
    std::string_view geometry_height = keys.geometry;
    const std::string_view geometry_width = take(geometry_height, 'x');
    if (auto r = agree_on_size(header, "geometry", geometry_width, geometry_height); !r) return r.error();
  }
  if (!keys.width.empty() || !keys.height.empty()) {
    if (auto r = agree_on_size(header, "Width and Height", keys.width, keys.height); !r) return r.error();
  }
  if (!keys.version.empty()) {
    header.dat_version = integer_from(keys.version);
    if (!header.dat_version) return bad(text("the header's Version '", keys.version, "' is not a number"));
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
  std::vector<HeaderLine> camera;
  bool any = false;
  const uint64_t begin = input.consumed();
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
    if (!is_reading_key(key)) camera.push_back({std::string(key), std::string(line)});
    any = true;
    input.skip(*length);
    if (input.consumed() - begin > kMaxHeader) {
      return bad(text("the header is longer than ", kMaxHeader, " bytes"));
    }
  }
  if (!any) return std::optional<PropheseeHeader>();
  // Behind the recording's own header come places in it, which would pass as words.
  if (keys.index) {
    return Error{ErrorCode::unrecognised,
                 "this is an index that OpenEB keeps beside a recording (NAME.raw.tmp_index), no recording; "
                 "name the recording itself"};
  }
  auto header = interpret(keys);
  if (!header) return header.error();
  header->camera = std::move(camera);
  return std::optional(*std::move(header));
}

bool is_camera_line(const HeaderLine& line) {
  const auto is_text = [](const std::string& s) { return std::none_of(s.begin(), s.end(), is_control); };
  // The marks around the text and the end of the line belong to it.
  constexpr size_t kMarks = 4;
  return !is_reading_key(line.key) && line.key.find(' ') == line.key.npos && is_text(line.key) &&
         is_text(line.value) && line.key.size() + line.value.size() + kMarks <= kMaxLine;
}

std::string prophesee_header_text(std::string_view format, SensorSize sensor,
                                  std::span<const HeaderLine> camera) {
  std::string lines;
  if (format == kDat) {
    lines = text("% Data file containing CD events.\n% Version 2\n% Height ", sensor.height, "\n% Width ",
                 sensor.width, "\n");
  } else {
    const auto* const word_format = std::find_if(std::begin(kWordFormats), std::end(kWordFormats),
                                                 [&](const WordFormat& f) { return f.name == format; });
    // Without it readers guess EVT2.1's byte order from the camera.
    const std::string_view byte_order = format == "evt21" ? ";endianness=little" : "";
    lines =
        text("% evt ", word_format->version, "\n% format ", word_format->key, byte_order,
             ";height=", sensor.height, ";width=", sensor.width, "\n% geometry ", size_text(sensor), "\n");
  }
  for (const HeaderLine& line : camera) {
    lines += text("% ", line.key, line.value.empty() ? "" : " ", line.value, "\n");
  }
  return lines + "% end\n";
}

}  // namespace scarf
