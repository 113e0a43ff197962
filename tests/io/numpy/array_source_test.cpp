// NumPy arrays byte by byte, in files, archives and folders.
#include <gmock/gmock.h>

#include <bit>
#include <string>

#include "tests/io/io_test_helpers.h"
#include "tests/support/archive_bytes.h"

namespace scarf {
namespace {

using test::npy_file;
using test::zip_file;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Number>
Bytes numbers(std::initializer_list<Number> values) {
  Bytes bytes;
  for (const Number value : values) {
    if constexpr (std::is_same_v<Number, double>) {
      append_little_endian(bytes, std::bit_cast<uint64_t>(value));
    } else if constexpr (std::is_same_v<Number, float>) {
      append_little_endian(bytes, std::bit_cast<uint32_t>(value));
    } else {
      append_little_endian(bytes, value);
    }
  }
  return bytes;
}

const std::vector<Event> kTwo = {{258, 1, 2, 1}, {70'000, 3, 4, 0}};

TEST(NpyReader, FieldsInAnyOrderWithPaddingAndOtherFields) {
  // t u4, padding of 3, y i2 big-endian, p bool, two numbers that are no event's, x u1.
  const Bytes records = {2,    1,    0, 0, 9, 9, 9, 0, 2, 1, 7, 7, 7, 7, 1,  //
                         0x70, 0x11, 1, 0, 9, 9, 9, 0, 4, 0, 7, 7, 7, 7, 3};
  for (const int version : {1, 2, 3}) {
    const auto r =
        read_all(npy_file("[('t', '<u4'), ('', '|V3'), ('y', '>i2'), ('on', '|b1'), ('speed', '<f2', "
                          "(2,)), (('title', 'x'), '|u1')]",
                          "(2,)", records, version));
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.format, "npy");
    EXPECT_EQ(r.sensor, std::nullopt);
    EXPECT_EQ(r.events, kTwo);
    EXPECT_EQ(r.report.unknown_words + r.report.truncated_bytes + r.report.damages, 0u);
  }
}

TEST(NpyReader, ARowOfIntegersPerEvent) {
  const Bytes txyp = numbers<int64_t>({258, 1, 2, 1, 70'000, 3, 4, 0});
  EXPECT_EQ(read_all(npy_file("'<i8'", "(2, 4)", txyp)).events, kTwo);
  const Bytes xypt = numbers<int32_t>({1, 2, 1, 99, 258, 3, 4, -1, 99, 70'000});
  EXPECT_EQ(read_all(npy_file("'<i4'", "(2, 5)", xypt), read_options("", "xyp_t")).events, kTwo);
  const auto in_ms = read_all(npy_file("'<i8'", "(2, 4)", txyp), read_options("", "", "ms"));
  ASSERT_EQ(in_ms.events.size(), 2u);
  EXPECT_EQ(in_ms.events[1].t, 70'000'000);
  const auto in_ns = read_all(npy_file("'<i8'", "(2, 4)", txyp), read_options("", "", "ns"));
  ASSERT_EQ(in_ns.events.size(), 2u);
  EXPECT_EQ(in_ns.events[0].t, 0);
  EXPECT_EQ(in_ns.events[1].t, 70);
}

TEST(NpyReader, FloatingPointTimesAreSeconds) {
  const Bytes doubles = numbers<double>({0.000258, 1, 2, 1, 0.07, 3, 4, -1});
  EXPECT_EQ(read_all(npy_file("'<f8'", "(2, 4)", doubles)).events, kTwo);
  const Bytes floats = numbers<float>({0.000258f, 1, 2, 1, 0.07f, 3, 4, 0});
  EXPECT_EQ(read_all(npy_file("'<f4'", "(2, 4)", floats)).events, kTwo);
  const Bytes whole = numbers<double>({258, 1, 2, 1, 70'000, 3, 4, 0});
  EXPECT_THAT(read_all(npy_file("'<f8'", "(2, 4)", whole)).error, HasSubstr("ReadOptions::time_unit"));
  EXPECT_EQ(read_all(npy_file("'<f8'", "(2, 4)", whole), read_options("", "", "us")).events, kTwo);
}

TEST(NpyReader, TimesWithAUnitOfTheirOwn) {
  constexpr int64_t kNotATime = std::numeric_limits<int64_t>::min();
  Bytes records;
  for (const int64_t t : {int64_t{258'499}, int64_t{-258'501}, int64_t{-258'500}, kNotATime, kNotATime + 1}) {
    const Bytes time = numbers<int64_t>({t});
    records.insert(records.end(), time.begin(), time.end());
    records.insert(records.end(), {1, 2, 1});
  }
  const auto r =
      read_all(npy_file("[('t', '<m8[ns]'), ('x', 'u1'), ('y', 'u1'), ('p', 'u1')]", "(5,)", records));
  EXPECT_EQ(r.error, "");
  EXPECT_THAT(r.events, ElementsAre(Event{258, 1, 2, 1}, Event{-259, 1, 2, 1}, Event{-258, 1, 2, 1},
                                    Event{-9'223'372'036'854'776, 1, 2, 1}));
  EXPECT_EQ(r.report.unknown_words, 1u);
}

TEST(NpyReader, NumbersThatAreNoEventsAreCounted) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto r = read_all(
      npy_file("'<f8'", "(8, 4)", numbers<double>({0.1,   1,        2, 1,     //
                                                   nan,   1,        2, 1,     // no time
                                                   1e300, 1,        2, 1,     // none that scarf can hold
                                                   0.2,   1.5,      2, 1,     // no pixel
                                                   0.2,   1,        2, 2,     // no polarity
                                                   0.2,   -1,       2, 1,     // outside
                                                   0.2,   65536,    2, 1,     //
                                                   0.3,   infinity, 2, 1})),  // no pixel
      read_options("", "txyp"));
  EXPECT_EQ(r.error, "");
  EXPECT_THAT(r.events, ElementsAre(Event{100'000, 1, 2, 1}));
  EXPECT_EQ(r.report.unknown_words, 4u);
  EXPECT_EQ(r.report.undefined_polarities, 1u);
  EXPECT_EQ(r.report.outside, 2u);
}

TEST(NpyReader, ACutArrayIsDamage) {
  Bytes rows = numbers<int32_t>({258, 1, 2, 1, 70'000, 3});
  const auto r = read_all(npy_file("'<i4'", "(2, 4)", rows));
  EXPECT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.report.truncated_bytes, 8u);
  EXPECT_EQ(r.report.damages, 1u);
  EXPECT_EQ(read_all(npy_file("'<i4'", "(0, 4)", {})).error, "");
  const auto longer = read_all(npy_file("'<i4'", "(1, 4)", rows));
  EXPECT_EQ(longer.events.size(), 1u);
  EXPECT_THAT(longer.report.damage->what, HasSubstr("8 bytes follow"));
}

TEST(NpyReader, AsksWhatItCannotTell) {
  const Bytes xytp = numbers<int32_t>({5, 2, 258, 1, 3, 4, 70'000, 0});
  EXPECT_THAT(read_all(npy_file("'<i4'", "(2, 4)", xytp)).error, HasSubstr("ReadOptions::columns"));
  const Bytes ptyx = numbers<int32_t>({1, 258, 2, 5, 0, 70'000, 4, 3});
  EXPECT_THAT(read_all(npy_file("'<i4'", "(2, 4)", ptyx)).error, HasSubstr("ReadOptions::columns"));
  EXPECT_THAT(read_all(npy_file("'<i4'", "(1, 5)", xytp)).error,
              AllOf(HasSubstr("5 columns"), HasSubstr("ReadOptions::columns")));
  EXPECT_THAT(read_all(npy_file("'<i4'", "(8,)", xytp)).error, HasSubstr("neither"));
  EXPECT_THAT(read_all(npy_file("'<i4'", "(2, 4)", xytp, 1, "True")).error, HasSubstr("ascontiguousarray"));
  EXPECT_THAT(read_all(npy_file("[('t', '<i4'), ('x', '<i4')]", "(2,)", xytp)).error, HasSubstr("rename"));
  EXPECT_THAT(read_all(npy_file("'|O'", "(2, 4)", xytp)).error, HasSubstr("neither"));
  EXPECT_THAT(read_all(npy_file("'<i4'", "(2, 4)", xytp), read_options("", "txypc")).error,
              HasSubstr("use _ instead of c"));
  EXPECT_THAT(read_all(npy_file("'<i4'", "(2, 4)", xytp), read_options("", "txyp_")).error,
              HasSubstr("4 columns, not 5"));
}

TEST(NpyReader, NamesOfOtherTools) {
  const Bytes rows = numbers<int32_t>({258, 1, 2, 1, 70'000, 3, 4, 0});
  for (const char* names : {"[('timestamp', '<i4'), ('x', '<i4'), ('y', '<i4'), ('polarity', '<i4')]",
                            "[('T', '<i4'), ('X', '<i4'), ('Y', '<i4'), ('P', '<i4')]",
                            "[('ts', '<i4'), ('xs', '<i4'), ('ys', '<i4'), ('is_increase', '<i4')]",
                            "[('time_us', '<i4'), ('x', '<i4'), ('y', '<i4'), ('pol', '<i4')]"}) {
    EXPECT_EQ(read_all(npy_file(names, "(2,)", rows)).events, kTwo) << names;
  }
  // A unit in a name counts as one of the type's.
  const auto ns = read_all(npy_file("[('t_ns', '<i4'), ('x', '<i4'), ('y', '<i4'), ('on', '<i4')]", "(2,)",
                                    numbers<int32_t>({500, 1, 2, 1, 1499, 3, 4, 0})));
  ASSERT_EQ(ns.events.size(), 2u) << ns.error;
  EXPECT_EQ(ns.events[0].t, 1);
  EXPECT_EQ(ns.events[1].t, 1);
}

TEST(NpyReader, FieldsAreNamedWhereTheirNamesSayNothing) {
  const auto named = [](const std::string& columns) {
    // A time, two numbers in a field, and two polarities.
    const Bytes rows = {2, 1, 0, 0, 1, 2, 1, 0, 0x70, 0x11, 1, 0, 3, 4, 0, 1};
    return read_all(
        npy_file("[('when', '<u4'), ('where', '|u1', (2,)), ('sign', '|u1'), ('p', '|u1')]", "(2,)", rows),
        read_options("", columns));
  };
  EXPECT_EQ(named("t=when,x=where[0],y=where[1],p=sign").events, kTwo);
  EXPECT_EQ(named("p=sign,y=where[1],x=where[0],t=when").events, kTwo);
  EXPECT_THAT(named("").error, HasSubstr("ReadOptions::columns"));
  EXPECT_THAT(named("t=wann,x=where[0],y=where[1],p=sign").error,
              AllOf(HasSubstr("wann"), HasSubstr("when")));
  EXPECT_THAT(named("t=when,x=where,y=where[1],p=sign").error, HasSubstr("2 columns"));
  EXPECT_THAT(named("t=when,x=where[2],y=where[1],p=sign").error, HasSubstr("2 columns"));
  EXPECT_THAT(named("t=when,x=where[0],y=where[1]").error, HasSubstr("each of t, x, y and p"));
  EXPECT_THAT(named("t=when,x=where[0],y=where[1],p=sign,p=p").error, HasSubstr("each of t, x, y and p"));
  const Bytes xytp = numbers<int32_t>({1, 2, 258, 1, 3, 4, 70'000, 0});
  EXPECT_EQ(read_all(npy_file("'<i4'", "(2, 4)", xytp), read_options("", "t=[2],x=[0],y=[1],p=[3]")).events,
            kTwo);
}

TEST(NpyReader, BrokenHeaders) {
  for (const char* type :
       {"[('t', '<u4'", "'<i4", "3", "[]]", "[('x', '<u9999999999')]", "[('a', 'V60000', (60000, 60000))]"}) {
    EXPECT_THAT(read_all(npy_file(type, "(2,)", {})).error, HasSubstr("header")) << type;
  }
  for (const char* shape : {"(2", "2", "(-1,)", "(99999999999999999999999,)"}) {
    EXPECT_THAT(read_all(npy_file("'<i4'", shape, {})).error, HasSubstr("header")) << shape;
  }
  EXPECT_THAT(read_all(npy_file("'<i4'", "(2,)", {}, 4)).error, HasSubstr("version 4"));
  EXPECT_THAT(read_all(bytes_of("\x93NUMPY\1")).error, HasSubstr("none of NumPy"));
}

class NpzReader : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto missing = missing_library("npz"); !missing.empty()) GTEST_SKIP() << missing;
  }

  Recording read(const std::vector<std::pair<std::string, Bytes>>& members, const ReadOptions& options = {}) {
    const TemporaryFile file(zip_file(members));
    return read_path(file.path(), options);
  }

  const Bytes rows_ = npy_file("'<i4'", "(2, 4)", numbers<int32_t>({258, 1, 2, 1, 70'000, 3, 4, 0}));
  const Bytes object_ = npy_file("'|O'", "()", bytes_of("pickled"));
};

TEST_F(NpzReader, TheOneArrayWithEvents) {
  const auto r = read({{"meta.npy", object_}, {"samples.npy", rows_}, {"note.txt", bytes_of("hello")}});
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "npz");
  EXPECT_EQ(r.events, kTwo);
}

TEST_F(NpzReader, OfSeveralTheOneThatIsNamedOrCalledEvents) {
  const Bytes other = npy_file("'<i4'", "(1, 4)", numbers<int32_t>({9, 8, 7, 1}));
  EXPECT_EQ(read({{"other.npy", other}, {"events.npy", rows_}}).events, kTwo);
  EXPECT_THAT(read({{"left.npy", other}, {"right.npy", rows_}}).error,
              AllOf(HasSubstr("left, right"), HasSubstr("ReadOptions::stream")));
  EXPECT_EQ(read({{"left.npy", other}, {"right.npy", rows_}}, read_options("right")).events, kTwo);
  EXPECT_THAT(read({{"left.npy", other}}, read_options("middle")).error, HasSubstr("no array 'middle'"));
  EXPECT_THAT(read({{"meta.npy", object_}}).error, HasSubstr("meta"));
}

TEST_F(NpzReader, AnArrayPerColumn) {
  const std::pair<std::string, Bytes> t{"t.npy",
                                        npy_file("'<f8'", "(2,)", numbers<double>({0.000258, 0.07}))};
  const std::pair<std::string, Bytes> x{"x.npy", npy_file("'|u1'", "(2,)", {1, 3})};
  const std::pair<std::string, Bytes> y{"y.npy", npy_file("'<u2'", "(2,)", {2, 0, 4, 0})};
  const std::pair<std::string, Bytes> p{"p.npy", npy_file("'|b1'", "(2,)", {1, 0})};
  const auto r = read({p, t, {"K.npy", object_}, x, y});
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.events, kTwo);
  EXPECT_NE(read({p, t, x, {"y.npy", npy_file("'<u2'", "(1,)", {2, 0})}}).error, "");
}

TEST_F(NpzReader, ArraysAreNamedWhereTheirNamesSayNothing) {
  const std::pair<std::string, Bytes> t{"when.npy",
                                        npy_file("'<u4'", "(2,)", {2, 1, 0, 0, 0x70, 0x11, 1, 0})};
  const std::pair<std::string, Bytes> xy{"where.npy", npy_file("'|u1'", "(2, 2)", {1, 2, 3, 4})};
  const std::pair<std::string, Bytes> p{"more.npy",
                                        npy_file("[('a', '|u1'), ('b', '|u1')]", "(2,)", {7, 1, 7, 0})};
  const auto named = [&](const std::string& columns) { return read({t, xy, p}, read_options("", columns)); };
  EXPECT_EQ(named("t=when,x=where[0],y=where[1],p=more/b").events, kTwo);
  EXPECT_THAT(named("t=when,x=where[0],y=where[1],p=more/c").error,
              AllOf(HasSubstr("c"), HasSubstr("more/b")));
  EXPECT_THAT(named("t=when,x=where[0],y=where[1],p=more").error, HasSubstr("more/b"));
  EXPECT_THAT(named("t=wann,x=where[0],y=where[1],p=more/b").error,
              AllOf(HasSubstr("wann"), HasSubstr("when")));
  EXPECT_THAT(read({t, xy, {"p.npy", npy_file("'|b1'", "(1,)", {1})}},
                   read_options("", "t=when,x=where[0],y=where[1],p=p"))
                  .error,
              HasSubstr("different lengths"));
}

TEST_F(NpzReader, TooManyArraysAreRefused) {
  std::vector<std::pair<std::string, Bytes>> members;
  for (int i = 0; i < 256; ++i) members.emplace_back(std::to_string(i) + ".npy", object_);
  EXPECT_THAT(read(members).error, HasSubstr("none of the arrays"));
  members.emplace_back("events.npy", rows_);
  EXPECT_THAT(read(members).error, HasSubstr("more than 256 arrays"));
}

TEST_F(NpzReader, ADamagedMemberIsDamage) {
  // More than the reader's buffer, so that what is before the damage is handed out.
  Bytes content;
  for (uint32_t i = 0; i < 100'000; ++i) {
    for (const uint32_t value : {i, 1u, 2u, 1u}) append_little_endian(content, value);
  }
  Bytes zip = zip_file({{"events.npy", npy_file("'<i4'", "(100000, 4)", content)}});
  zip[1'500'004] ^= 1;
  const TemporaryFile file(zip);
  const auto r = read_path(file.path());
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.report.damages, 1u);
  zip.resize(zip.size() - 30);
  const TemporaryFile cut(zip);
  EXPECT_THAT(read_path(cut.path()).error, HasSubstr("zip"));
}

class Evimo2Reader : public ::testing::Test {
 protected:
  void add(const Bytes& t, const Bytes& xy, const Bytes& p) {
    folder_.add("dataset_events_t.npy", t);
    folder_.add("dataset_events_xy.npy", xy);
    folder_.add("dataset_events_p.npy", p);
  }

  const TemporaryFolder folder_;
  const Bytes t_ = npy_file("'<f4'", "(2,)", numbers<float>({0.000258f, 0.07f}));
  const Bytes xy_ = npy_file("'<u2'", "(2, 2)", {1, 0, 2, 0, 3, 0, 4, 0});
  const Bytes p_ = npy_file("'|u1'", "(2,)", {1, 0});
};

TEST_F(Evimo2Reader, ThreeArraysAreOneRecording) {
  add(t_, xy_, p_);
  const auto r = read_path(folder_.path());
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "evimo2");
  EXPECT_EQ(r.events, kTwo);
}

TEST_F(Evimo2Reader, NamesTheArrayThatDoesNotFit) {
  add(t_, xy_, npy_file("'|u1'", "(3,)", {1, 0, 1}));
  EXPECT_THAT(read_path(folder_.path()).error, AllOf(HasSubstr("dataset_events_p.npy"), HasSubstr("3 rows")));
  add(t_, p_, p_);
  EXPECT_THAT(read_path(folder_.path()).error,
              AllOf(HasSubstr("dataset_events_xy.npy"), HasSubstr("2 numbers")));
  std::filesystem::remove(folder_.path() + "/dataset_events_xy.npy");
  EXPECT_THAT(read_path(folder_.path()).error, HasSubstr("dataset_events_xy.npy"));
}

}  // namespace
}  // namespace scarf
