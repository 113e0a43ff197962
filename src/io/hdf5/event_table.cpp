#include "io/hdf5/event_table.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/text.h"
#include "io/hdf5/ecf_codec.h"

namespace scarf::hdf5 {
namespace {

constexpr size_t kSlot = 8;  // bytes of a member of a record in memory; the largest number has as many

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

Error no_numbers(const std::string& path) {
  return bad(text(path, " does not hold integers or floating-point numbers"));
}

}  // namespace

Result<EventTable> EventTable::open(const Handle& file, const Layout& layout, const std::string& place,
                                    const std::string& columns) {
  const Turn turn;
  EventTable table;
  Result<void> opened;
  switch (layout.shape) {
    case Shape::columns:
      opened = table.open_columns(file, layout, place);
      break;
    case Shape::array:
      opened = table.open_array(file, layout, place, columns);
      break;
    case Shape::compound:
      opened = table.open_records(file, layout, place);
      break;
  }
  if (!opened) return opened.error();
  if (layout.shape != Shape::array && !columns.empty()) {
    return Error{ErrorCode::illegal_parameter,
                 text("--columns is for arrays of four columns; ", place, " has names; leave it out")};
  }
  table.compare_rows();
  return table;
}

Result<void> EventTable::open_columns(const Handle& file, const Layout& layout, const std::string& place) {
  for (size_t i = 0; i < fields_.size(); ++i) {
    auto dataset = Dataset::open(file, dataset_of(layout, place, i));
    if (!dataset) return dataset.error();
    const auto type = number_type(dataset->type().id());
    if (!type) return no_numbers(dataset->path());
    if (dataset->row_values() != 1)
      return bad(text(dataset->path(), " is no column: it has further dimensions"));
    parts_.push_back({*std::move(dataset), Handle(), memory_type(*type), size_of(*type), {}});
    fields_[i] = {i, 0, *type};
  }
  return {};
}

Result<void> EventTable::open_array(const Handle& file, const Layout& layout, const std::string& place,
                                    const std::string& columns) {
  auto dataset = Dataset::open(file, place);
  if (!dataset) return dataset.error();
  const auto type = number_type(dataset->type().id());
  if (!type) return no_numbers(place);
  if (dataset->shape().size() != 2 || dataset->shape()[1] != fields_.size()) {
    return bad(text(place, " is no array of rows of four numbers"));
  }
  std::string order = columns;
  for (const std::string_view name : layout.names) order += columns.empty() ? name : "";
  if (order.empty()) {
    return Error{ErrorCode::illegal_parameter,
                 text(place, " does not name its columns; give their order with --columns, such as xytp")};
  }
  if (order.size() != fields_.size()) order.clear();
  for (size_t i = 0; i < fields_.size(); ++i) {
    const size_t column = order.find("xytp"[i]);
    if (column == order.npos) {
      return Error{ErrorCode::illegal_parameter,
                   text("--columns ", columns, " does not name each of x, y, t, p once")};
    }
    fields_[i] = {0, column * size_of(*type), *type};
  }
  parts_.push_back({*std::move(dataset), Handle(), memory_type(*type), fields_.size() * size_of(*type), {}});
  return {};
}

Result<void> EventTable::open_records(const Handle& file, const Layout& layout, const std::string& place) {
  auto dataset = Dataset::open(file, place);
  if (!dataset) return dataset.error();
  if (dataset->row_values() != 1) return bad(text(place, " has more than one dimension"));
  const Handle type = dataset->type();
  if (H5Tget_class(type.id()) != H5T_COMPOUND) return bad(text(place, " does not hold records"));
  if (dataset->ecf()) {
    if (dataset->chunk_end(0) > kEcfMaxEvents) {
      return bad(text(place, " has ECF chunks of more than ", kEcfMaxEvents, " events"));
    }
    fields_ = {Place{0, offsetof(Event, x), NumberType::u16}, Place{0, offsetof(Event, y), NumberType::u16},
               Place{0, offsetof(Event, t), NumberType::i64}, Place{0, offsetof(Event, p), NumberType::u8}};
    parts_.push_back({*std::move(dataset), Handle(), H5I_INVALID_HID, sizeof(Event), {}});
    return {};
  }
  Handle record(H5Tcreate(H5T_COMPOUND, kSlot * fields_.size()));
  for (size_t i = 0; i < fields_.size(); ++i) {
    const std::string name(layout.names[i]);
    const int member = H5Tget_member_index(type.id(), name.c_str());
    if (member < 0) return bad(text("the records of ", place, " have no ", name));
    const Handle member_type(H5Tget_member_type(type.id(), static_cast<unsigned>(member)));
    const auto number = number_type(member_type.id());
    if (!number) return no_numbers(text(place, ".", name));
    fields_[i] = {0, kSlot * i, *number};
    H5Tinsert(record.id(), name.c_str(), kSlot * i, memory_type(*number));
  }
  const hid_t id = record.id();
  parts_.push_back({*std::move(dataset), std::move(record), id, kSlot * fields_.size(), {}});
  return {};
}

void EventTable::compare_rows() {
  const auto fewer = [](const Part& a, const Part& b) { return a.dataset.rows() < b.dataset.rows(); };
  const auto [least, most] = std::minmax_element(parts_.begin(), parts_.end(), fewer);
  rows_ = least->dataset.rows();
  if (most->dataset.rows() != rows_) {
    disagreement_ = text(most->dataset.path(), " has ", most->dataset.rows(), " rows, but ",
                         least->dataset.path(), " has ", rows_);
  }
}

uint64_t EventTable::chunk_end(uint64_t row) const {
  uint64_t end = rows_;
  for (const Part& part : parts_) end = std::min(end, part.dataset.chunk_end(row));
  return end;
}

std::optional<BrokenRows> EventTable::read(uint64_t first, size_t count) {
  for (Part& part : parts_) {
    const Dataset& dataset = part.dataset;
    if (!dataset.ecf()) part.rows.resize(count * part.row_bytes);
    const auto done = dataset.ecf() ? read_ecf(part, first, count)
                                    : dataset.read(first, count, part.type, part.rows.data());
    if (done) continue;
    const uint64_t end = std::min(dataset.chunk_end(first), rows_);
    return BrokenRows{
        end, dataset.byte_of(first),
        text("rows ", first, " to ", end - 1, " of ", dataset.path(), ": ", done.error().message)};
  }
  return std::nullopt;
}

// `first` begins a chunk, and the rows lie in it.
Result<void> EventTable::read_ecf(const Part& part, uint64_t first, size_t count) {
  bool filtered = false;
  if (auto r = part.dataset.read_chunk(first, chunk_, filtered); !r) return r;
  if (!filtered) return bad("the chunk was stored without ECF");
  if (auto r = decode_ecf(chunk_, events_); !r) return r;
  // A chunk at the end may hold more than the dataset has.
  if (events_.size() < count) return bad(text("the chunk holds ", events_.size(), " events only"));
  events_.resize(count);
  return {};
}

bool EventTable::written(uint64_t first, uint64_t count) const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return part.dataset.written(first, count); });
}

Numbers EventTable::numbers(Field field) const {
  const Place& place = fields_[field];
  const Part& part = parts_[place.part];
  const uint8_t* const rows =
      by_chunk() ? reinterpret_cast<const uint8_t*>(events_.data()) : part.rows.data();
  return {rows + place.offset, part.row_bytes, place.type};
}

}  // namespace scarf::hdf5
