#include "io/hdf5/find_columns.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/base/columns.h"
#include "io/base/named_columns.h"
#include "io/base/streams.h"
#include "io/hdf5/dataset.h"
#include "io/hdf5/number_type.h"

namespace scarf::hdf5 {
namespace {

constexpr int kMaxDepth = 8;
constexpr size_t kMaxObjects = 4096;
// Fields in the order of FieldPlaces, as letters.
constexpr std::string_view kFields = "xytp";

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

// Which field a column is; nullopt for none.
std::optional<size_t> field_of(Column column) {
  switch (column) {
    case Column::x:
      return 0;
    case Column::y:
      return 1;
    case Column::t:
      return 2;
    case Column::p:
      return 3;
    default:
      return std::nullopt;
  }
}

// Fields by the names of what holds them; complete if each is there once.
class Fields {
 public:
  void add(const std::string& name, FieldPlace place) {
    const ColumnName known = column_name(name);
    const auto field = field_of(known.column);
    if (!field) return;
    ++times_[*field];
    places_.fields[*field] = std::move(place);
    if (known.column == Column::t) places_.time_exponent = known.time_exponent;
  }
  bool complete() const {
    return std::all_of(times_.begin(), times_.end(), [](int times) { return times == 1; });
  }
  EventPlaces places(const std::string& where) {
    places_.where = where;
    return places_;
  }

 private:
  EventPlaces places_;
  std::array<int, 4> times_{};
};

// What a file holds, as far as it may be events.
struct Contents {
  std::vector<EventPlaces> events;
  std::vector<std::string> datasets;  // of numbers
  std::vector<std::string> columns;   // what --columns can name: these, and members of records
  size_t objects = 0;
};

herr_t collect_name(hid_t, const char* name, const H5L_info_t* info, void* names) {
  auto& list = *static_cast<std::vector<std::string>*>(names);
  // Soft and external links lead to where their targets are, which is found there or not at all.
  if (info->type == H5L_TYPE_HARD) list.emplace_back(name);
  return list.size() < kMaxObjects ? 0 : 1;
}

void look_at_records(const Handle& type, const std::string& path, Contents& contents) {
  Fields fields;
  const int count = H5Tget_nmembers(type.id());
  for (int i = 0; i < count; ++i) {
    char* const name = H5Tget_member_name(type.id(), static_cast<unsigned>(i));
    if (name == nullptr) continue;
    fields.add(name, {path, name, std::nullopt, 0});
    contents.columns.push_back(text(path, "/", name));
    H5free_memory(name);
  }
  if (fields.complete()) contents.events.push_back(fields.places(path));
}

void look_at_group(const Handle& group, const std::string& path, int depth, Contents& contents) {
  std::vector<std::string> names;
  H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names);
  Fields fields;
  for (const std::string& name : names) {
    if (++contents.objects > kMaxObjects) return;
    if (name.starts_with('#')) continue;  // what MATLAB keeps for itself
    const Handle object(H5Oopen(group.id(), name.c_str(), H5P_DEFAULT));
    const std::string inside = text(path, "/", name);
    const H5I_type_t kind = H5Iget_type(object.id());
    if (kind == H5I_GROUP && depth < kMaxDepth) look_at_group(object, inside, depth + 1, contents);
    if (kind != H5I_DATASET) continue;
    const Handle type(H5Dget_type(object.id()));
    if (H5Tget_class(type.id()) == H5T_COMPOUND) {
      look_at_records(type, inside, contents);
    } else if (number_type(type.id())) {
      contents.datasets.push_back(inside);
      contents.columns.push_back(inside);
      fields.add(name, {inside, "", std::nullopt, 0});
    }
  }
  if (fields.complete()) contents.events.push_back(fields.places(path.empty() ? "/" : path));
}

Contents contents_of(const Handle& file) {
  Contents contents;
  const Handle root(H5Gopen2(file.id(), "/", H5P_DEFAULT));
  if (root) look_at_group(root, "", 0, contents);
  return contents;
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr size_t kMost = 20;
  std::string list;
  for (size_t i = 0; i < names.size() && i < kMost; ++i) list += text(i == 0 ? "" : ", ", names[i]);
  return names.size() > kMost ? text(list, " and ", names.size() - kMost, " more") : list;
}

// A name out of the options: that of a dataset, or of a dataset of records with a member's behind it.
Result<FieldPlace> place_named(const Handle& file, const NamedColumn& named) {
  if (Dataset::exists(file, named.name)) return FieldPlace{named.name, "", named.index, 0};
  const size_t slash = named.name.rfind('/');
  if (slash != std::string::npos && slash > 0 && !named.index) {
    const std::string dataset = named.name.substr(0, slash);
    if (Dataset::exists(file, dataset)) {
      return FieldPlace{dataset, named.name.substr(slash + 1), std::nullopt, 0};
    }
  }
  const auto columns = contents_of(file).columns;
  return bad(text("has no dataset ", named.name, " of ReadOptions::columns; ",
                  columns.empty() ? "it holds no columns of numbers" : text("it holds ", list_of(columns))));
}

Result<EventPlaces> events_named(const Handle& file, const ReadOptions& options) {
  const auto named = named_columns_from(options.columns);
  if (!named) return named.error();
  if (!options.stream.empty()) {
    return Error{ErrorCode::illegal_parameter,
                 "ReadOptions::columns names the datasets; leave out ReadOptions::stream"};
  }
  EventPlaces places;
  for (size_t i = 0; i < named->size(); ++i) {
    constexpr Column kOrder[] = {Column::t, Column::x, Column::y, Column::p};
    const size_t field = *field_of(kOrder[i]);
    auto place = place_named(file, (*named)[i]);
    if (!place) return place.error();
    places.fields[field] = *std::move(place);
  }
  const FieldPlace& t = places.fields[2];
  const std::string& name = t.member.empty() ? t.dataset : t.member;
  places.time_exponent = column_name(name.substr(name.rfind('/') + 1)).time_exponent;
  places.where = places.fields[0].dataset;
  places.where.resize(places.where.rfind('/') == std::string::npos ? 0 : places.where.rfind('/'));
  return places;
}

// The dataset that has as many columns as the options give letters.
Result<EventPlaces> events_of_array(const Handle& file, const Contents& contents,
                                    const ReadOptions& options) {
  const auto order = columns_from(options.columns);
  if (!order) return order.error();
  std::vector<StreamName> arrays;
  for (const std::string& path : contents.datasets) {
    const auto dataset = Dataset::open(file, path, across_of(order->size()));
    if (dataset && dataset->shape().size() == 2 && dataset->row_values() == order->size()) {
      arrays.push_back({path, text(dataset->rows(), " rows")});
    }
  }
  const auto chosen = choose_stream(options.stream, arrays, text("arrays of ", order->size(), " columns"));
  if (!chosen) return chosen.error();
  return places_of_array(arrays[*chosen].name, *order);
}

}  // namespace

Result<EventPlaces> find_events(const Handle& file, const ReadOptions& options) {
  const Turn turn;
  if (names_columns(options.columns)) return events_named(file, options);
  const Contents contents = contents_of(file);
  if (!options.columns.empty()) return events_of_array(file, contents, options);
  if (contents.events.empty()) {
    return Error{ErrorCode::unrecognised,
                 text("this HDF5 file has no events: no columns whose names scarf knows; ",
                      contents.columns.empty() ? "it holds no columns of numbers"
                                               : text("it holds ", list_of(contents.columns),
                                                      ", which ReadOptions::columns "
                                                      "can name, such as t=/a/ts,x=/a/xs,y=/a/ys,p=/a/pol"))};
  }
  std::vector<StreamName> names;
  for (const EventPlaces& places : contents.events) {
    const bool records = !places.fields[0].member.empty();
    names.push_back({places.where, records ? "records" : "columns"});
  }
  const auto chosen = choose_stream(options.stream, names, "tables of events");
  if (!chosen) return chosen.error();
  return contents.events[*chosen];
}

}  // namespace scarf::hdf5
