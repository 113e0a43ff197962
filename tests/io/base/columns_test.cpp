#include "io/base/columns.h"

#include <gtest/gtest.h>

namespace scarf {
namespace {

TEST(ColumnNames, OneTableKnowsThem) {
  for (const char* name : {"t", "T", "ts", "Time", "timestamp", "TIMESTAMPS", "\"t\"", "'ts'", " time ",
                           "event_timestamp", "events/t", "time_stamp", "Time Stamp"}) {
    EXPECT_EQ(column_name(name).column, Column::t) << name;
    EXPECT_EQ(column_name(name).time_exponent, std::nullopt) << name;
  }
  for (const char* name : {"x", "X", "xs", "\"x\"", "x [px]", "x(pixel)", "x_px", "pos_x", "events.x"}) {
    EXPECT_EQ(column_name(name).column, Column::x) << name;
  }
  for (const char* name : {"y", "Ys", "y_coordinate", "event_y"}) {
    EXPECT_EQ(column_name(name).column, Column::y) << name;
  }
  for (const char* name : {"p", "ps", "pol", "Polarity", "polarities", "on", "ON", "`p`"}) {
    EXPECT_EQ(column_name(name).column, Column::p) << name;
  }
  EXPECT_EQ(column_name("camera").column, Column::camera);
}

TEST(ColumnNames, MaySayTheUnitOfTimes) {
  const struct {
    const char* name;
    int exponent;
  } cases[] = {{"time_us", 0},        {"t_ns", -3},        {"timestamp_s", 6},       {"ts_ms", 3},
               {"Timestamp [us]", 0}, {"t(s)", 6},         {"\"time (ms)\"", 3},     {"time/us", 0},
               {"t [\xc2\xb5s]", 0},  {"t_\xce\xbcs", 0},  {"timestamp_nsec", -3},   {"t.us", 0},
               {"event_t_us", 0},     {"time_seconds", 6}, {"time-microseconds", 0}, {"ts:ns", -3}};
  for (const auto& c : cases) {
    EXPECT_EQ(column_name(c.name).column, Column::t) << c.name;
    EXPECT_EQ(column_name(c.name).time_exponent, c.exponent) << c.name;
  }
}

TEST(ColumnNames, WhatSaysNothingIsSkipped) {
  for (const char* name : {"", "\"\"", "label", "index", "x_us", "p_us", "t_px", "tt", "us", "_",
                           "time_of_day", "event", "event_", "t_hours", "1", "x y"}) {
    EXPECT_EQ(column_name(name).column, Column::skipped) << name;
  }
}

}  // namespace
}  // namespace scarf
