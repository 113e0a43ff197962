#include "compare/state_dump.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/files/byte_writer.h"
#include "scarf/digest/digest.h"

namespace scarf {
namespace {

constexpr std::string_view kMagic = "SCARFST1";
constexpr size_t kIntegers = 13;
constexpr size_t kHeaderBytes = kMagic.size() + kIntegers * sizeof(int32_t);
constexpr size_t kSlotBytes = 14;

std::array<int32_t, kIntegers> integers_of(const Geometry& g) {
  return {g.x.size, g.y.size,      g.x.cell,      g.y.cell,      g.x.origin,    g.y.origin, g.x.grid,
          g.y.grid, g.x.margin_lo, g.y.margin_lo, g.x.margin_hi, g.y.margin_hi, g.capacity};
}

Geometry geometry_of(const std::array<int32_t, kIntegers>& v) {
  return {{v[0], v[2], v[4], v[6], v[8], v[10]}, {v[1], v[3], v[5], v[7], v[9], v[11]}, v[12]};
}

}  // namespace

Result<void> write_state_dump(const std::string& path, const Snapshot& snapshot, const OutputRule& rule) {
  auto file = ByteWriter::create(path, rule);
  if (!file) return file.error();
  file->append(kMagic);
  for (const int32_t integer : integers_of(snapshot.geometry)) file->append_word(integer);
  for (size_t patch = 0; patch < snapshot.totals.size(); ++patch) {
    const std::vector<uint8_t> hashed = state_bytes(snapshot, patch);
    file->append({reinterpret_cast<const char*>(hashed.data()), hashed.size()});
    if (auto r = file->flush_if_large(); !r) return r;
  }
  return file->finish();
}

Result<StateDump> StateDump::open(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{ErrorCode::io, text("cannot open ", path)};
  std::array<uint8_t, kHeaderBytes> header{};
  file.read(reinterpret_cast<char*>(header.data()), header.size());
  if (!file || !std::equal(kMagic.begin(), kMagic.end(), header.begin())) {
    return Error{ErrorCode::bad_input, text(path, " is no state dump; write_state_dump() writes one")};
  }
  std::array<int32_t, kIntegers> integers{};
  for (size_t i = 0; i < kIntegers; ++i) {
    integers[i] = load_little_endian<int32_t>(&header[kMagic.size() + i * sizeof(int32_t)]);
  }
  const auto geometry = checked_geometry(geometry_of(integers));
  if (!geometry)
    return Error{ErrorCode::bad_input, text(path, ": illegal header: ", geometry.error().message)};
  StateDump dump(path, std::move(file));
  dump.geometry_ = *geometry;
  return dump;
}

Result<DumpedPatch> StateDump::next() {
  std::array<uint8_t, 8> total{};
  file_.read(reinterpret_cast<char*>(total.data()), total.size());
  DumpedPatch patch;
  patch.total = load_little_endian<uint64_t>(total.data());
  patch.slots.resize(std::min<uint64_t>(patch.total, geometry_.capacity));
  std::vector<uint8_t> bytes(patch.slots.size() * kSlotBytes);
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file_)
    return Error{ErrorCode::bad_input, text(path_, " ends within patch ", patch_, "; write it anew")};

  const auto column = static_cast<int32_t>(patch_ % geometry_.x.grid);
  const auto row = static_cast<int32_t>(patch_ / geometry_.x.grid);
  for (size_t slot = 0; slot < patch.slots.size(); ++slot) {
    const uint8_t* b = &bytes[slot * kSlotBytes];
    Event& e = patch.slots[slot];
    e = {.t = load_little_endian<int64_t>(b + 6),
         .x = load_little_endian<uint16_t>(b),
         .y = load_little_endian<uint16_t>(b + 2),
         .p = b[4]};
    if (b[5] != (geometry_.x.active(e.x, column) && geometry_.y.active(e.y, row))) {
      return Error{ErrorCode::bad_input,
                   text(path_, ": patch ", patch_, " slot ", slot,
                        " has an active flag that contradicts its place; write it anew")};
    }
  }
  ++patch_;
  return patch;
}

Result<void> StateDump::finish() {
  if (file_.peek() == std::ifstream::traits_type::eof()) return {};
  return Error{ErrorCode::bad_input, text(path_, " goes on behind its last patch; write it anew")};
}

}  // namespace scarf
