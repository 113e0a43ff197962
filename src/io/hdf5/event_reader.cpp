// Events of HDF5 files, in any of the layouts.
#include <algorithm>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/base/block_source.h"
#include "io/base/columns.h"
#include "io/base/named_columns.h"
#include "io/base/rounding.h"
#include "io/base/sensor_size.h"
#include "io/hdf5/event_table.h"
#include "io/hdf5/find_columns.h"
#include "io/hdf5/reader.h"

namespace scarf::hdf5 {
namespace {

constexpr size_t kBlockRows = 32 * 1024;
// Chunks in a row that were never written: beyond that the rest of a dataset is not looked at, because a file
// of any size can claim any number of rows.
constexpr uint64_t kMaxHoles = 64 * 1024;

// Microseconds of a unit of time as a fraction.
struct TimeUnit {
  int64_t numerator = 1;
  int64_t denominator = 1;
};

TimeUnit unit_of(int exponent) {
  TimeUnit unit;
  for (; exponent > 0; --exponent) unit.numerator *= 10;
  for (; exponent < 0; ++exponent) unit.denominator *= 10;
  return unit;
}

// Whether the first times are floating-point numbers that could as well be seconds as anything smaller.
bool are_ambiguous(EventTable& table) {
  constexpr uint64_t kLook = 4096;
  const auto count = static_cast<size_t>(std::min({kLook, table.rows(), table.chunk_end(0)}));
  if (!is_float(table.time_type()) || count == 0 || !table.written(0, count) || table.read(0, count))
    return false;
  std::vector<int64_t> fractions(count);
  std::vector<int64_t> others(count);
  table.numbers(EventTable::t).transform(fractions, [](auto v) {
    return static_cast<double>(v) != std::floor(static_cast<double>(v)) ? 1 : 0;
  });
  table.numbers(EventTable::t).transform(others, [](auto v) { return v != 0 ? 1 : 0; });
  const auto one = [](int64_t v) { return v == 1; };
  return std::none_of(fractions.begin(), fractions.end(), one) &&
         std::any_of(others.begin(), others.end(), one);
}

Result<TimeUnit> time_unit(const std::string& given, Family family, const EventPlaces& places,
                           EventTable& table) {
  const auto exponent = time_exponent_from(given);
  if (!exponent) return exponent.error();
  if (*exponent) return unit_of(**exponent);
  if (places.time_exponent) return unit_of(*places.time_exponent);
  if (!is_float(table.time_type())) return TimeUnit{};
  if (family == Family::other && places.fields[EventTable::t].column) {
    return Error{
        ErrorCode::illegal_parameter,
        "the times are floating-point numbers of an unknown unit; give it with ReadOptions::time_unit"};
  }
  if (family == Family::other && are_ambiguous(table)) {
    return Error{
        ErrorCode::bad_input,
        "the times are floating-point numbers without fractions, so that seconds and microseconds look "
        "alike; name the unit with ReadOptions::time_unit"};
  }
  return unit_of(6);
}

// kNoInteger for what is no time.
template <class T>
int64_t microseconds(T value, TimeUnit unit) {
  if constexpr (std::is_floating_point_v<T>) {
    const auto t = static_cast<double>(value);
    return nearest_integer(unit.denominator == 1 ? t * static_cast<double>(unit.numerator)
                                                 : t / static_cast<double>(unit.denominator));
  } else {
    const int64_t t = as_integer(value);
    int64_t result = 0;
    if (unit.denominator == 1)
      return __builtin_mul_overflow(t, unit.numerator, &result) ? kNoInteger : result;
    return rounded_quotient(t, unit.denominator);
  }
}

class Reader final : public BlockSource {
 public:
  Reader(Handle file, EventTable table, TimeUnit unit, int64_t t_offset, std::string_view format,
         uint64_t bytes, std::string name, std::optional<SensorSize> sensor, const ReadOptions& options)
      : BlockSource(std::move(name), sensor, options),
        file_(std::move(file)),
        table_(std::move(table)),
        unit_(unit),
        t_offset_(t_offset),
        format_(format),
        bytes_(bytes) {
    if (table_.disagreement()) tally_.note_damage(0, *table_.disagreement());
  }

  std::string_view format() const override { return format_; }
  uint64_t bytes_read() const override {
    if (row_ >= table_.rows()) return bytes_;
    return static_cast<uint64_t>(static_cast<double>(row_) / static_cast<double>(table_.rows()) *
                                 static_cast<double>(bytes_));
  }
  uint64_t bytes_total() const override { return bytes_; }

 protected:
  Result<bool> next(std::vector<Event>& block) override {
    if (at_ == t_.size() && !load()) return false;
    if (t_.empty()) {
      block.swap(table_.events());
      return true;
    }
    // What no Event can hold is counted in its turn, between the events before and behind it.
    for (; at_ < t_.size() && !tally_.failure(); ++at_) {
      if (!legal_time(t_[at_])) {
        ++tally_.report.unknown_words;
        if (tally_.strict()) {
          tally_.fail({ErrorCode::bad_input, text("row ", block_row_ + at_, " has no time that scarf holds; ",
                                                  "leave out ReadOptions::strict to pass over it")});
        }
      } else if (p_[at_] == kUndefined) {
        tally_.leave_out_polarity("row", block_row_ + at_);
      } else if (outside(at_)) {
        tally_.drop(t_[at_]);
      } else {
        break;
      }
    }
    block.reserve(t_.size() - at_);
    for (; at_ < t_.size() && legal_time(t_[at_]) && p_[at_] != kUndefined && !outside(at_); ++at_) {
      Event& e = block.emplace_back();
      e.t = t_[at_];
      e.x = static_cast<uint16_t>(x_[at_]);
      e.y = static_cast<uint16_t>(y_[at_]);
      e.p = static_cast<uint8_t>(p_[at_]);
    }
    return true;
  }

 private:
  static constexpr int64_t kUndefined = 2;  // of polarities

  static bool legal_time(int64_t t) { return t > -kMaxTime && t < kMaxTime; }
  bool outside(size_t i) const { return ((x_[i] | y_[i]) & ~int64_t{0xFFFF}) != 0; }

  // Reads the next rows that can be read. False: there are none.
  bool load() {
    while (row_ < table_.rows() && !tally_.failure()) {
      const uint64_t chunk = table_.chunk_end(row_) - row_;
      const bool piecewise = table_.by_chunk() || row_ < piecewise_until_;
      const uint64_t left = std::min<uint64_t>(kBlockRows, table_.rows() - row_);
      const auto count = static_cast<size_t>(table_.by_chunk() ? chunk
                                             : piecewise       ? std::min(left, chunk)
                                                               : left);
      std::optional<BrokenRows> broken;
      if (!table_.written(row_, count)) {
        if (piecewise && ++holes_ > kMaxHoles) return end_at_hole();
        broken =
            BrokenRows{row_ + count, 0, text("rows ", row_, " to ", row_ + count - 1, " were never written")};
      } else {
        broken = table_.read(row_, count);
      }
      if (auto r = check_reading(file_); !r) {
        tally_.fail(r.error());
        return false;
      }
      if (!broken) {
        holes_ = 0;
        has_whole_events() ? t_.clear() : convert(count);
        block_row_ = row_;
        row_ += count;
        at_ = 0;
        return true;
      }
      if (!piecewise) {
        piecewise_until_ = row_ + count;
        continue;
      }
      tally_.note_damage(broken->byte, std::move(broken->what));
      row_ = broken->end;
    }
    return false;
  }

  bool end_at_hole() {
    tally_.note_damage(0, text("rows ", row_, " to ", table_.rows() - 1, " were never written"));
    row_ = table_.rows();
    return false;
  }

  // Whether the rows read are events already, and all of them events that scarf holds.
  bool has_whole_events() {
    return table_.by_chunk() && std::all_of(table_.events().begin(), table_.events().end(),
                                            [](const Event& e) { return legal_time(e.t); });
  }

  void convert(size_t count) {
    for (auto* const field : {&x_, &y_, &t_, &p_}) field->resize(count);
    const auto whole = [](auto v) { return as_integer(v); };
    table_.numbers(EventTable::x).transform(x_, whole);
    table_.numbers(EventTable::y).transform(y_, whole);
    table_.numbers(EventTable::t).transform(t_, [&](auto v) {
      int64_t t = microseconds(v, unit_);
      return __builtin_add_overflow(t, t_offset_, &t) ? kNoInteger : t;
    });
    table_.numbers(EventTable::p).transform(p_, [](auto v) {
      // Compared in its own type: a fraction, NaN and a negative number without its sign are neither.
      using T = decltype(v);
      if (v == T{1}) return int64_t{1};
      if (v == T{0}) return int64_t{0};
      if constexpr (std::is_signed_v<T>) return v == T{-1} ? int64_t{0} : kUndefined;
      return kUndefined;
    });
  }

  Handle file_;
  EventTable table_;
  const TimeUnit unit_;
  const int64_t t_offset_;
  const std::string_view format_;
  const uint64_t bytes_;
  uint64_t row_ = 0;  // the next to be read
  uint64_t piecewise_until_ = 0;
  uint64_t holes_ = 0;
  uint64_t block_row_ = 0;  // the first of those below
  size_t at_ = 0;
  std::vector<int64_t> x_, y_, t_, p_;  // none if the rows read are whole events
};

// Where the events of a family are, and the sensor size that the file says.
struct Found {
  EventPlaces places;
  std::optional<SensorSize> sensor;
};

Result<Found> find(const Handle& file, Family family, const ReadOptions& options) {
  const bool other = family == Family::other;
  const bool search = other && (names_columns(options.columns) || !options.stream.empty());
  const Layout* const layout = search ? nullptr : find_layout(file, family);
  Found found;
  if (layout != nullptr) {
    const auto place = place_of(file, *layout, options.stream);
    if (!place) return place.error();
    auto places = places_of(*layout, *place, options.columns);
    if (!places) return places.error();
    found.places = *std::move(places);
    if (layout->sensor != nullptr) found.sensor = layout->sensor(file, *place);
  } else if (other) {
    auto places = find_events(file, options);
    if (!places) return places.error();
    found.places = *std::move(places);
    const std::string& where = found.places.where;
    found.sensor = sensor_beside(file, where.ends_with('/') ? where : where + "/");
  } else {
    return Error{ErrorCode::bad_input, text("has no events as ", name_of(family), " has them")};
  }
  return found;
}

}  // namespace

bool recognise(const std::string& path, Family family) {
  const Turn turn;
  const auto file = open_file(path);
  // Else another format would be asked, which may take it for its own.
  if (!file && file.error().code == ErrorCode::out_of_memory) throw std::bad_alloc();
  // What could not be read is no reason to take it for another format; open() says what is wrong.
  return file ? find_layout(*file, family) != nullptr || !check_reading(*file)
              : file.error().code == ErrorCode::io;
}

Result<std::unique_ptr<EventSource>> open(Input input, const ReadOptions& options, Family family) {
  if (auto r = require_path(input, "HDF5"); !r) return r.error();
  const Turn turn;
  auto file = open_file(input.path);
  if (!file) return file.error();
  const auto found = find(*file, family, options);
  if (auto r = check_reading(*file); !r) return r.error();
  if (!found) return found.error();
  auto table = EventTable::open(*file, found->places);
  if (!table) return table.error();
  const auto unit = time_unit(options.time_unit, family, found->places, *table);
  if (!unit) return unit.error();
  const std::optional<SensorSize>& size = found->sensor;
  if (size) {
    const auto legal = checked_sensor(size->width, size->height, "the HDF5 file");
    if (!legal) return legal.error();
  }
  const auto sensor = agreed_sensor(size, options.sensor);
  if (!sensor) return sensor.error();
  int64_t t_offset = 0;
  if (family == Family::dsec && Dataset::exists(*file, "t_offset")) {
    const auto value = short_dataset(*file, "t_offset");
    if (!value) return Error{ErrorCode::bad_input, "t_offset is no integer"};
    t_offset = value->front();
  }
  if (auto r = check_reading(*file); !r) return r.error();
  return std::unique_ptr<EventSource>(std::make_unique<Reader>(*std::move(file), *std::move(table), *unit,
                                                               t_offset, name_of(family), input.bytes.total(),
                                                               std::move(input.name), *sensor, options));
}

}  // namespace scarf::hdf5
