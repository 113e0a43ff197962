// Reader of EV-IMO2 folders: an array of times, one of places and one of polarities.
// Source: better-flow/evimo, format of version 2; times are seconds.

#include <filesystem>
#include <utility>

#include "core/text.h"
#include "io/base/known_formats.h"
#include "io/numpy/array_source.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "evimo2";
constexpr std::string_view kTimes = "dataset_events_t.npy";
constexpr std::string_view kPlaces = "dataset_events_xy.npy";
constexpr std::string_view kPolarities = "dataset_events_p.npy";

// An array of `width` numbers per event, added to the others.
Result<void> add(const Input& folder, std::string_view file, std::vector<Column> contents,
                 EventArrays& events) {
  const auto named = [&](const Error& error) { return Error{error.code, text(file, ": ", error.message)}; };
  auto bytes = folder.files->open_regular(text(folder.path, "/", file));
  if (!bytes) return named(bytes.error());
  const auto header = read_numpy_header(*bytes);
  if (!header) return named(header.error());
  const std::vector<uint64_t>& shape = header->shape;
  const size_t width = contents.size();
  const bool as_wide = width == 1 ? shape.size() == 1 : shape.size() == 2 && shape[1] == width;
  if (header->named || !as_wide || !is_number(header->fields[0].type)) {
    return named({ErrorCode::bad_input, text("the array has not ", width, " numbers per event")});
  }
  if (const auto r = require_row_order(*header); !r) return named(r.error());
  if (!events.arrays.empty() && shape[0] != events.rows) {
    return named({ErrorCode::bad_input,
                  text("the array has ", shape[0], " rows, and ", kTimes, " has ", events.rows)});
  }
  events.rows = shape[0];
  for (size_t i = 0; i < width; ++i) {
    events.columns.push_back(
        {contents[i], events.arrays.size(), i * header->item_bytes, header->fields[0].type});
  }
  events.arrays.push_back({*std::move(bytes), width * header->item_bytes});
  return {};
}

Result<std::unique_ptr<EventSource>> open_evimo2(Input input, const ReadOptions& options) {
  if (!input.folder) {
    return Error{ErrorCode::bad_input, text("EV-IMO2 is a folder with ", kTimes, "; name the folder")};
  }
  EventArrays events;
  events.named = true;
  if (auto r = add(input, kTimes, {Column::t}, events); !r) return r.error();
  if (auto r = add(input, kPlaces, {Column::x, Column::y}, events); !r) return r.error();
  if (auto r = add(input, kPolarities, {Column::p}, events); !r) return r.error();
  return open_arrays(kName, input.name, std::move(events), options);
}

bool recognise_evimo2(const Beginning& beginning) {
  std::error_code ignored;
  return beginning.folder && std::filesystem::is_regular_file(text(beginning.path, "/", kTimes), ignored);
}

}  // namespace

const Format kEvimo2Format = {.name = kName,
                              .title = "EV-IMO2 folder (dataset_events_t.npy, _xy.npy, _p.npy)",
                              .options = kTakesTimeUnit,
                              .recognise = recognise_evimo2,
                              .open = open_evimo2};

}  // namespace scarf
