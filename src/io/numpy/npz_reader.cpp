// Reader of NumPy archives (.npz): zip archives of arrays, EV-IMO's among them.
// Source: NumPy, numpy.savez; better-flow/evimo, whose array `events` has rows t, x, y, p.

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/known_formats.h"
#include "io/base/named_columns.h"
#include "io/base/zip_archive.h"
#include "io/numpy/array_source.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "npz";
constexpr std::string_view kExtension = ".npy";
// The array that is taken if there are several and none is named.
constexpr std::string_view kPreferred = "events";
// Each is open, with a buffer of its own, until one is chosen.
constexpr size_t kMaxArrays = 256;

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

// All arrays whose header is understood.
Result<std::vector<NamedArray>> arrays_of(const ZipArchive& archive) {
  std::vector<NamedArray> arrays;
  for (const auto& member : archive.members()) {
    if (!member.name.ends_with(kExtension)) continue;
    auto bytes = archive.read(member);
    if (!bytes) return bytes.error();
    auto header = read_numpy_header(*bytes);
    if (!header) continue;
    if (arrays.size() == kMaxArrays) {
      return bad(text("the archive holds more than ", kMaxArrays, " arrays; save those of the events apart"));
    }
    arrays.push_back({member.name.substr(0, member.name.size() - kExtension.size()), *std::move(header),
                      *std::move(bytes)});
  }
  return arrays;
}

std::string names_of(const std::vector<NamedArray*>& arrays) {
  std::string list;
  for (const NamedArray* array : arrays) list += text(list.empty() ? "" : ", ", array->name);
  return list.empty() ? "none" : list;
}

// An array per column: t, x, y and p. Empty if they are not there.
EventArrays column_arrays(std::vector<NamedArray>& arrays) {
  EventArrays events;
  events.named = true;
  std::vector<Column> contents;
  std::vector<NamedArray*> taken;
  for (NamedArray& array : arrays) {
    const Column content = column_named(array.name);
    const bool usable = content != Column::skipped && content != Column::camera;
    if (!usable || array.header.named || array.header.shape.size() != 1) continue;
    contents.push_back(content);
    taken.push_back(&array);
  }
  const auto same_length = [&](const NamedArray* a) { return a->header.shape == taken[0]->header.shape; };
  if (!are_complete(contents) || !std::all_of(taken.begin(), taken.end(), same_length)) return events;
  if (!std::all_of(taken.begin(), taken.end(),
                   [](const NamedArray* a) { return is_number(a->header.fields[0].type); })) {
    return events;
  }
  events.rows = taken[0]->header.shape[0];
  for (size_t i = 0; i < taken.size(); ++i) {
    events.columns.push_back({contents[i], i, 0, taken[i]->header.fields[0].type});
    add_unit(events.columns.back(), taken[i]->name);
    events.arrays.push_back({std::move(taken[i]->bytes), taken[i]->header.item_bytes});
  }
  return events;
}

// Whether some array, or all together by their names, could be events if they were whole and well named.
bool may_hold_events(const std::vector<NamedArray>& arrays) {
  const auto has = [&](Column content) {
    return std::any_of(arrays.begin(), arrays.end(),
                       [&](const NamedArray& a) { return column_named(a.name) == content; });
  };
  if (has(Column::t) && has(Column::x) && has(Column::y) && has(Column::p)) return true;
  return std::any_of(arrays.begin(), arrays.end(),
                     [](const NamedArray& a) { return may_hold_events(a.header); });
}

Result<NamedArray*> choose(std::vector<NamedArray>& arrays, const ReadOptions& options) {
  size_t width = 4;
  if (!options.columns.empty()) width = options.columns.size();
  std::vector<NamedArray*> candidates;
  std::vector<NamedArray*> all;
  for (NamedArray& array : arrays) {
    all.push_back(&array);
    if (holds_events(array.header, width)) candidates.push_back(&array);
    const std::string_view wanted = options.stream.empty() ? kPreferred : options.stream;
    if (array.name == wanted && (!options.stream.empty() || holds_events(array.header, width))) return &array;
  }
  if (!options.stream.empty()) {
    return bad(text("there is no array '", options.stream, "'; the archive holds ", names_of(all)));
  }
  if (candidates.size() == 1) return candidates[0];
  if (candidates.empty()) {
    const bool hope = may_hold_events(arrays);
    return Error{hope ? ErrorCode::bad_input : ErrorCode::unrecognised,
                 text("none of the arrays (", names_of(all), ") has fields or columns t, x, y, p",
                      hope ? "; name the columns of one with ReadOptions::stream and ReadOptions::columns, "
                             "such as txyp_, or "
                             "arrays with ReadOptions::columns, "
                             "such as t=ts,x=xs,y=ys,p=pol"
                           : "")};
  }
  return bad(
      text("several arrays hold events: ", names_of(candidates), "; choose one with ReadOptions::stream"));
}

Result<std::unique_ptr<EventSource>> open_npz(Input input, const ReadOptions& options) {
  if (const auto r = require_path(input, "a NumPy archive"); !r) return r.error();
  const auto archive = ZipArchive::open(input.path);
  if (!archive) return archive.error();
  auto arrays = arrays_of(*archive);
  if (!arrays) return arrays.error();
  if (names_columns(options.columns)) {
    if (!options.stream.empty()) {
      return Error{ErrorCode::illegal_parameter,
                   "ReadOptions::columns names the arrays; leave out ReadOptions::stream"};
    }
    auto events = columns_by_name(*std::move(arrays), options.columns);
    if (!events) return events.error();
    return open_arrays(kName, input.name, *std::move(events), options);
  }
  if (options.stream.empty() && options.columns.empty()) {
    auto events = column_arrays(*arrays);
    if (!events.arrays.empty()) return open_arrays(kName, input.name, std::move(events), options);
  }
  const auto chosen = choose(*arrays, options);
  if (!chosen) return chosen.error();
  auto events = columns_of_array(std::move((*chosen)->bytes), (*chosen)->header, options);
  if (!events)
    return Error{events.error().code, text("array ", (*chosen)->name, ": ", events.error().message)};
  return open_arrays(kName, input.name, *std::move(events), options);
}

bool recognise_npz(const Beginning& beginning) {
  if (!looks_like_zip(beginning.bytes) || beginning.path.empty()) return false;
  const auto archive = ZipArchive::open(beginning.path);
  return archive && std::any_of(archive->members().begin(), archive->members().end(),
                                [](const auto& member) { return member.name.ends_with(kExtension); });
}

}  // namespace

const Format kNpzFormat = {.name = kName,
                           .title = "NumPy archive (.npz), arrays as in npy or one per column; EV-IMO",
                           .options = kTakesColumns | kTakesTimeUnit | kTakesStream,
                           .missing = kZipMissing,
                           .recognise = recognise_npz,
                           .open = open_npz};

}  // namespace scarf
