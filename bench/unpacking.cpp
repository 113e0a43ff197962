#include "bench/unpacking.h"

#include <algorithm>
#include <utility>

#include "io/aedat/aedat4.h"

#if SCARF_HDF5
#include "io/hdf5/event_table.h"
#endif

namespace scarf::bench {
namespace {

Result<void> unpack_aedat4(const std::string& path, const ReadOptions& options) {
  auto bytes = ByteReader::open(path);
  if (!bytes) return bytes.error();
  auto packets =
      aedat4::Packets::open({*std::move(bytes), path, path, false, {}}, options, "EVTS", "event streams");
  if (!packets) return packets.error();
  for (;;) {
    const auto packet = packets->next();
    if (!packet) return packet.error();
    if (!*packet) return {};
  }
}

#if SCARF_HDF5
constexpr uint64_t kRowsAtOnce = 32 * 1024;

// False: the layout is of another format.
Result<bool> unpack_hdf5(const std::string& path, hdf5::Family family, const ReadOptions& options) {
  const auto file = hdf5::open_file(path);
  if (!file) return file.error();
  const hdf5::Layout* const layout = hdf5::find_layout(*file, family);
  if (layout == nullptr) return false;
  const auto place = hdf5::place_of(*file, *layout, options.stream);
  if (!place) return place.error();
  const auto places = hdf5::places_of(*layout, *place, options.columns);
  if (!places) return places.error();
  auto table = hdf5::EventTable::open(*file, *places);
  if (!table) return table.error();
  for (uint64_t row = 0; row < table->rows();) {
    const uint64_t left = table->rows() - row;
    const uint64_t count = table->by_chunk() ? table->chunk_end(row) - row : std::min(left, kRowsAtOnce);
    if (const auto broken = table->read(row, static_cast<size_t>(count))) {
      return Error{ErrorCode::bad_input, broken->what};
    }
    row += count;
  }
  return true;
}
#endif

}  // namespace

Result<bool> unpack_blocks(const std::string& path, std::string_view format, const ReadOptions& options) {
  if (format == "aedat4") {
    if (auto r = unpack_aedat4(path, options); !r) return r.error();
    return true;
  }
#if SCARF_HDF5
  using enum hdf5::Family;
  for (const hdf5::Family family : {metavision, mvsec, m3ed, dsec, rvt, event_utils, other}) {
    if (format == hdf5::name_of(family)) return unpack_hdf5(path, family, options);
  }
#endif
  return false;
}

}  // namespace scarf::bench
