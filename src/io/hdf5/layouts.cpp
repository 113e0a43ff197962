#include "io/hdf5/layouts.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "core/text.h"
#include "io/hdf5/dataset.h"

namespace scarf::hdf5 {
namespace {

constexpr std::string_view kLeftRight[] = {"left", "right"};

// Sizes as they stand, unchecked but for their range.
std::optional<SensorSize> size_from(int64_t width, int64_t height) {
  const auto fits = [](int64_t v) { return v >= INT32_MIN && v <= INT32_MAX; };
  if (!fits(width) || !fits(height)) return SensorSize{-1, -1};
  return SensorSize{static_cast<int32_t>(width), static_cast<int32_t>(height)};
}

std::optional<SensorSize> size_of_metavision(const Handle& file, const std::string&) {
  const auto value = root_text(file, "geometry");
  if (!value) return std::nullopt;
  int32_t width = 0;
  int32_t height = 0;
  const char* const end = value->data() + value->size();
  const auto w = std::from_chars(value->data(), end, width);
  if (w.ec != std::errc() || w.ptr == end || *w.ptr != 'x') return SensorSize{-1, -1};
  const auto h = std::from_chars(w.ptr + 1, end, height);
  if (h.ec != std::errc() || h.ptr != end) return SensorSize{-1, -1};
  return SensorSize{width, height};
}

// Of the frames beside the events.
std::optional<SensorSize> size_of_mvsec(const Handle& file, const std::string& place) {
  const std::string images = place.substr(0, place.rfind('/')) + "/image_raw";
  if (!Dataset::exists(file, images)) return std::nullopt;
  const auto dataset = Dataset::open(file, images);
  if (!dataset || dataset->shape().size() != 3) return std::nullopt;
  return size_from(static_cast<int64_t>(dataset->shape()[2]), static_cast<int64_t>(dataset->shape()[1]));
}

std::optional<SensorSize> size_of_m3ed(const Handle& file, const std::string& place) {
  const auto size = short_dataset(file, place + "calib/resolution");
  if (!size || size->size() != 2) return std::nullopt;
  return size_from((*size)[0], (*size)[1]);
}

// Height, width and perhaps channels of the images. Without images the converter of event_utils writes the
// largest coordinates there, which is one pixel short; then the file is taken not to say.
std::optional<SensorSize> size_of_event_utils(const Handle& file, const std::string&) {
  const auto size = root_attribute(file, "sensor_resolution");
  const auto images = root_attribute(file, "num_imgs");
  if (!size || size->size() < 2 || (images && images->front() == 0)) return std::nullopt;
  return size_from((*size)[1], (*size)[0]);
}

using enum Shape;

// Asked in this order within a family; the families in the order of known_formats.
constexpr Layout kLayouts[] = {
    {.family = Family::metavision, .shape = compound, .place = "CD/events", .sensor = size_of_metavision},
    {.family = Family::mvsec,
     .shape = array,
     .place = "davis/*/events",
     .names = {"x", "y", "t", "p"},
     .streams = kLeftRight,
     .sensor = size_of_mvsec},
    {.family = Family::m3ed,
     .shape = columns,
     .place = "prophesee/*/",
     .streams = kLeftRight,
     .sensor = size_of_m3ed},
    {.family = Family::dsec,
     .shape = columns,
     .place = "events/",
     .mark = "t_offset",
     .sensor = sensor_beside},
    {.family = Family::dsec,
     .shape = columns,
     .place = "events/",
     .mark = "ms_to_idx",
     .sensor = sensor_beside},
    {.family = Family::rvt,
     .shape = columns,
     .place = "events/",
     .mark = "events/height",
     .sensor = sensor_beside},
    {.family = Family::event_utils,
     .shape = columns,
     .place = "events/",
     .names = {"xs", "ys", "ts", "ps"},
     .sensor = size_of_event_utils},
    {.family = Family::other, .shape = columns, .place = "events/", .sensor = sensor_beside},
    {.family = Family::other, .shape = columns, .place = "", .sensor = sensor_beside},
    {.family = Family::other, .shape = columns, .place = "", .names = {"xs", "ys", "ts", "ps"}},
    {.family = Family::other, .shape = compound, .place = "events"},
    {.family = Family::other, .shape = array, .place = "events", .names = {}},
};

std::string with_stream(std::string_view place, std::string_view stream) {
  std::string result(place);
  if (const size_t star = result.find('*'); star != result.npos) result.replace(star, 1, stream);
  return result;
}

// The dataset of field `i` (0 to 3: x, y, t, p).
std::string dataset_of(const Layout& layout, const std::string& place, size_t i) {
  return layout.shape == columns ? text(place, layout.names[i]) : place;
}

bool has_members(const Handle& type, const Layout& layout) {
  return std::all_of(layout.names.begin(), layout.names.end(), [&](std::string_view name) {
    return H5Tget_member_index(type.id(), std::string(name).c_str()) >= 0;
  });
}

bool has_events(const Handle& file, const Layout& layout, const std::string& place) {
  if (layout.shape == columns) {
    for (size_t i = 0; i < layout.names.size(); ++i) {
      if (!Dataset::exists(file, dataset_of(layout, place, i))) return false;
    }
    return true;
  }
  if (!Dataset::exists(file, place)) return false;
  if (layout.family != Family::other) return true;
  const auto dataset = Dataset::open(file, place);
  if (!dataset) return true;  // what is wrong is said when it is opened
  const Handle type = dataset->type();
  if (layout.shape == compound) return H5Tget_class(type.id()) == H5T_COMPOUND && has_members(type, layout);
  return H5Tget_class(type.id()) != H5T_COMPOUND && dataset->shape().size() == 2;
}

std::vector<std::string_view> streams_of(const Handle& file, const Layout& layout) {
  std::vector<std::string_view> found;
  for (const std::string_view stream : layout.streams) {
    if (has_events(file, layout, with_stream(layout.place, stream))) found.push_back(stream);
  }
  return found;
}

}  // namespace

const Layout* find_layout(const Handle& file, Family family) {
  for (const Layout& layout : kLayouts) {
    if (layout.family != family) continue;
    if (!layout.mark.empty() && !Dataset::exists(file, std::string(layout.mark))) continue;
    const bool found = layout.streams.empty() ? has_events(file, layout, std::string(layout.place))
                                              : !streams_of(file, layout).empty();
    if (found) return &layout;
  }
  return nullptr;
}

Result<std::string> place_of(const Handle& file, const Layout& layout, const std::string& wanted) {
  if (layout.streams.empty()) return std::string(layout.place);
  const auto streams = streams_of(file, layout);
  std::string list;
  for (const std::string_view stream : streams) {
    if (stream == wanted || (wanted.empty() && streams.size() == 1)) return with_stream(layout.place, stream);
    list += text(list.empty() ? "" : ", ", stream);
  }
  return Error{ErrorCode::illegal_parameter,
               wanted.empty() ? text("has several streams; choose one with ReadOptions::stream: ", list)
                              : text("has no stream ", wanted, "; there is ", list)};
}

std::optional<SensorSize> sensor_beside(const Handle& file, const std::string& place) {
  const auto width = short_dataset(file, place + "width");
  const auto height = short_dataset(file, place + "height");
  if (!width || !height) return std::nullopt;
  return size_from(width->front(), height->front());
}

Dataset::Across across_of(size_t columns) {
  return [columns](const std::vector<hsize_t>& shape, bool by_matlab) {
    if (columns > 0 && (shape[0] == columns) != (shape[1] == columns)) return shape[0] == columns;
    return shape[0] == shape[1] ? by_matlab : shape[0] < shape[1];
  };
}

EventPlaces places_of_array(const std::string& dataset, const std::vector<Column>& order) {
  EventPlaces places;
  places.where = dataset;
  constexpr Column kFields[] = {Column::x, Column::y, Column::t, Column::p};
  for (size_t i = 0; i < places.fields.size(); ++i) {
    const auto found = std::find(order.begin(), order.end(), kFields[i]);
    places.fields[i] = {dataset, "", static_cast<size_t>(found - order.begin()), order.size()};
  }
  return places;
}

Result<EventPlaces> places_of(const Layout& layout, const std::string& place, const std::string& given) {
  if (layout.shape == array) {
    std::string letters = given;
    for (const std::string_view name : layout.names) letters += given.empty() ? name : "";
    if (letters.empty()) {
      return Error{
          ErrorCode::illegal_parameter,
          text(place,
               " does not name its columns; give their order with ReadOptions::columns, such as xytp")};
    }
    const auto order = columns_from(letters);
    if (!order) return order.error();
    return places_of_array(place, *order);
  }
  if (!given.empty()) {
    return Error{ErrorCode::illegal_parameter,
                 text("ReadOptions::columns ", given, " is for arrays without names; ",
                      place.empty() ? "the root" : place, " has names; leave it out")};
  }
  EventPlaces places;
  places.where = place;
  for (size_t i = 0; i < places.fields.size(); ++i) {
    const std::string member(layout.shape == compound ? layout.names[i] : std::string_view());
    places.fields[i] = {dataset_of(layout, place, i), member, std::nullopt, 0};
  }
  return places;
}

}  // namespace scarf::hdf5
