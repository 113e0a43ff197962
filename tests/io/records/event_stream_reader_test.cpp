// Event Stream 2 byte by byte: DVS and ATIS.
#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A header for 320x240, and what follows.
Bytes es_file(uint8_t type, std::initializer_list<uint8_t> content, uint8_t major = 2) {
  Bytes bytes = bytes_of("Event Stream");
  bytes.insert(bytes.end(), {major, 0, 0, type});
  if (type != 0) bytes.insert(bytes.end(), {0x40, 1, 240, 0});
  bytes.insert(bytes.end(), content);
  return bytes;
}

TEST(EventStreamReader, DvsCountsTimeFromByteToByteAndRowsFromTheBottom) {
  const auto r = read_all(es_file(1, {
                                         7, 5, 0, 239, 0,            // 3 us on, ON, top row
                                         0xFF, 0xFF, 0, 2, 1, 0, 0,  // 254 us on, OFF, bottom row
                                         0xFE,                       // a reset: nothing
                                         253, 0, 0, 238, 0,          // 126 us on, ON
                                     }));
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "es");
  EXPECT_EQ(r.sensor, (SensorSize{320, 240}));
  EXPECT_THAT(r.events, ElementsAre(Event{3, 5, 0, 1}, Event{257, 258, 239, 0}, Event{383, 0, 1, 1}));
  EXPECT_EQ(r.report.unknown_words + r.report.truncated_bytes + r.report.outside, 0u);
}

TEST(EventStreamReader, AtisLeavesExposuresOut) {
  const auto r = read_all(es_file(2, {
                                         10 << 2,    1,    0, 239, 0,  // OFF
                                         1 << 2 | 2, 2,    0, 239, 0,  // ON
                                         5 << 2 | 1, 3,    0, 239, 0,  // an exposure begins: time goes on
                                         0 << 2 | 3, 4,    0, 239, 0,  // and ends
                                         0xFC,                         // a reset
                                         0xFF,       0xFD,             // 3 x 63 and 63 us
                                         62 << 2,    5,    0, 0,   0,  // the largest step of an event
                                     }));
  EXPECT_EQ(r.error, "");
  EXPECT_THAT(r.events,
              ElementsAre(Event{10, 1, 0, 0}, Event{11, 2, 0, 1}, Event{16 + 4 * 63 + 62, 5, 239, 0}));
  EXPECT_EQ(r.report.unknown_words, 0u);
}

TEST(EventStreamReader, PlacesOutsideTheSensorAreCounted) {
  const auto r = read_all(es_file(1, {
                                         1, 0x3F, 1,    0,    0,     // the last column
                                         1, 0x40, 1,    0,    0,     // one too far
                                         1, 0,    0,    240,  0,     // one row above the top
                                         1, 0xFF, 0xFF, 0xFF, 0xFF,  //
                                     }));
  EXPECT_THAT(r.events, ElementsAre(Event{0, 319, 239, 1}));
  EXPECT_EQ(r.report.outside, 3u);
}

TEST(EventStreamReader, AnEventCutShortIsTruncated) {
  const auto r = read_all(es_file(1, {1, 0, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.report.truncated_bytes, 3u);
}

TEST(EventStreamReader, SaysWhatItCannotRead) {
  EXPECT_THAT(read_all(es_file(0, {})).error, HasSubstr("generic"));
  EXPECT_THAT(read_all(es_file(3, {})).error, HasSubstr("type 3"));
  EXPECT_THAT(read_all(es_file(4, {})).error, HasSubstr("colours"));
  EXPECT_THAT(read_all(es_file(1, {}, 1)).error, HasSubstr("version 1"));
  Bytes cut = es_file(1, {});
  cut.pop_back();
  EXPECT_THAT(read_all(cut).error, HasSubstr("header"));
  Bytes no_rows = es_file(1, {});
  no_rows[18] = 0;
  EXPECT_THAT(read_all(no_rows).error, HasSubstr("320x0"));
  ReadOptions other;
  other.sensor = SensorSize{640, 480};
  EXPECT_THAT(read_all(es_file(1, {}), other).error, HasSubstr("640x480"));
}

TEST(NmnistReader, EventsAreFiveBytes) {
  const Bytes bytes = {5,  6,   0x80, 0x01, 0x02,  // ON, 258 us
                       7,  8,   0x7F, 0xFF, 0xFF,  // OFF, the latest time
                       0,  240, 0,    0,    0,     // the clock has overflowed
                       33, 33,  0,    0,    9,     //
                       1,  2};
  const auto r = read_all(bytes, read_options("", "", "", "nmnist"));
  EXPECT_EQ(r.error, "");
  EXPECT_THAT(r.events, ElementsAre(Event{258, 5, 6, 1}, Event{(1 << 23) - 1, 7, 8, 0},
                                    Event{(1 << 13) + 9, 33, 33, 0}));
  EXPECT_EQ(r.report.back_steps, 1u);
  EXPECT_EQ(r.report.truncated_bytes, 2u);
}

}  // namespace
}  // namespace scarf
