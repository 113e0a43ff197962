#include "io/hdf5/event_table.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/text.h"
#include "io/hdf5/ecf_codec.h"

namespace scarf::hdf5 {
namespace {

constexpr uint64_t kMaxColumns = 4096;
constexpr size_t kSlot = 8;  // bytes of a member of a record in memory; the largest number has as many

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

Error no_numbers(const std::string& path) {
  return bad(text(path, " does not hold integers or floating-point numbers"));
}

}  // namespace

Result<EventTable> EventTable::open(const Handle& file, const EventPlaces& places) {
  const Turn turn;
  EventTable table;
  std::vector<std::pair<std::string, Fields>> datasets;
  for (size_t i = 0; i < places.fields.size(); ++i) {
    const FieldPlace& place = places.fields[i];
    auto same = std::find_if(datasets.begin(), datasets.end(),
                             [&](const auto& dataset) { return dataset.first == place.dataset; });
    if (same == datasets.end()) same = datasets.insert(same, {place.dataset, {}});
    same->second.emplace_back(i, &place);
  }
  for (const auto& [path, fields] : datasets) {
    if (auto r = table.open_part(file, fields); !r) return r.error();
  }
  table.compare_rows();
  return table;
}

Result<void> EventTable::open_part(const Handle& file, const Fields& fields) {
  const FieldPlace& first = *fields.front().second;
  // A column or records by themselves are one column.
  const size_t columns = first.column ? first.columns : 1;
  auto dataset = Dataset::open(file, first.dataset, across_of(columns));
  if (!dataset) return dataset.error();
  const bool records = H5Tget_class(dataset->type().id()) == H5T_COMPOUND;
  return records ? add_records(*std::move(dataset), fields) : add_numbers(*std::move(dataset), fields);
}

Result<void> EventTable::add_numbers(Dataset dataset, const Fields& fields) {
  const std::string& path = dataset.path();
  const auto type = number_type(dataset.type().id());
  if (!type) return no_numbers(path);
  const uint64_t columns = dataset.row_values();
  const size_t bytes = size_of(*type);
  for (const auto& [field, place] : fields) {
    if (!place->member.empty()) return bad(text(path, " holds numbers, no records with ", place->member));
    if (!place->column && columns != 1) return bad(text(path, " is no column: it has further dimensions"));
    if (place->columns > 0 && (columns != place->columns || dataset.shape().size() != 2)) {
      return bad(text(path, " has ", columns, " columns, not ", place->columns,
                      "; name them with ReadOptions::columns, with _ for columns to skip"));
    }
    const size_t column = place->column.value_or(0);
    if (column >= columns || columns > kMaxColumns) {
      return bad(text(path, " has ", columns, " columns; there is none with the number ", column));
    }
    fields_[field] = {parts_.size(), column * bytes, *type};
  }
  parts_.push_back(
      {std::move(dataset), Handle(), memory_type(*type), static_cast<size_t>(columns) * bytes, {}});
  return {};
}

Result<void> EventTable::add_records(Dataset dataset, const Fields& fields) {
  const std::string path = dataset.path();
  if (dataset.row_values() != 1 || dataset.across()) return bad(text(path, " has more than one dimension"));
  const Handle type = dataset.type();
  if (dataset.ecf()) {
    if (fields.size() != fields_.size())
      return bad(text(path, " has whole events; take all columns from it"));
    if (dataset.chunk_end(0) > kEcfMaxEvents) {
      return bad(text(path, " has ECF chunks of more than ", kEcfMaxEvents, " events"));
    }
    fields_ = {Place{0, offsetof(Event, x), NumberType::u16}, Place{0, offsetof(Event, y), NumberType::u16},
               Place{0, offsetof(Event, t), NumberType::i64}, Place{0, offsetof(Event, p), NumberType::u8}};
    parts_.push_back({std::move(dataset), Handle(), H5I_INVALID_HID, sizeof(Event), {}});
    return {};
  }
  Handle record(H5Tcreate(H5T_COMPOUND, kSlot * fields.size()));
  size_t slot = 0;
  for (const auto& [field, place] : fields) {
    const std::string& name = place->member;
    if (name.empty() || place->column)
      return bad(text(path, " holds records; name a member, as in ", path, "/x"));
    const int member = H5Tget_member_index(type.id(), name.c_str());
    if (member < 0) return bad(text("the records of ", path, " have no ", name));
    const Handle member_type(H5Tget_member_type(type.id(), static_cast<unsigned>(member)));
    const auto number = number_type(member_type.id());
    if (!number) return no_numbers(text(path, ".", name));
    fields_[field] = {parts_.size(), slot, *number};
    H5Tinsert(record.id(), name.c_str(), slot, memory_type(*number));
    slot += kSlot;
  }
  const hid_t id = record.id();
  parts_.push_back({std::move(dataset), std::move(record), id, kSlot * fields.size(), {}});
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
  count_ = count;
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
  if (part.dataset.across())
    return {part.rows.data() + place.offset * count_, size_of(place.type), place.type};
  const uint8_t* const rows =
      by_chunk() ? reinterpret_cast<const uint8_t*>(events_.data()) : part.rows.data();
  return {rows + place.offset, part.row_bytes, place.type};
}

}  // namespace scarf::hdf5
