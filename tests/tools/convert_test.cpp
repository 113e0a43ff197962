// scarf convert and scarf cut.
#include "scarf/digest.h"
#include "scarf/io.h"
#include "tests/tools/program.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

class Copies : public Program {
 protected:
  std::string digest_of(const std::vector<Event>& events) const {
    EventDigest digest;
    for (const Event& e : events) digest.add(e);
    return digest.hex();
  }

  std::vector<Event> read(const std::string& file, const ReadOptions& options = {}) {
    const auto source = open_events(file, options);
    EXPECT_TRUE(source.ok()) << source.error().message;
    if (!source) return {};
    EXPECT_EQ((*source)->sensor().has_value(), true);
    std::vector<Event> events(100'000);
    size_t count = 0;
    for (;;) {
      const auto n = (*source)->read(std::span(events).subspan(count));
      EXPECT_TRUE(n.ok());
      if (!n || *n == 0) break;
      count += *n;
    }
    events.resize(count);
    return events;
  }
};

TEST_F(Copies, RoundTripsThroughEveryWriterKeepTheEvents) {
  const std::string original = recording();
  const std::string digest = digest_of(events_);
  size_t written = 0;
  for (const FormatInfo& format : formats()) {
    if (!format.written) continue;
    ++written;
    const std::string copy = path("copy." + format.name);
    const Outcome there = run("convert " + original + " " + copy + " --check --output-format " + format.name);
    EXPECT_EQ(there.exit_code, 0) << format.name << ": " << there.err;
    EXPECT_THAT(there.out, HasSubstr("\nlossless\n")) << format.name;
    EXPECT_THAT(there.out, HasSubstr("\nevents " + digest + "\n")) << format.name;
    const Outcome back = run("convert " + copy + " " + path("back.txt") +
                             " --overwrite --geometry 64x48 --format " + format.name);
    EXPECT_THAT(back.out, HasSubstr("\nevents " + digest + "\n")) << format.name;
  }
  EXPECT_GE(written, 3u);
}

TEST_F(Copies, TellWhatIsLostAndChanged) {
  std::vector<Event> events = events_at({50, 10, 60});
  {
    auto sink = *create_events(path("back.txt"), "text", kSensor);
    ASSERT_TRUE(sink->write(events).ok());
    ASSERT_TRUE(sink->finish().ok());
  }
  const Outcome refused = run("convert " + path("back.txt") + " " + path("a.raw"));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("before that of the event before it"));
  EXPECT_FALSE(std::filesystem::exists(path("a.raw"))) << "a refused copy leaves no file";

  const Outcome clamped = run("convert " + path("back.txt") + " " + path("a.raw") + " --time-policy clamp");
  EXPECT_THAT(clamped.out, HasSubstr("changed: 1 times of back-steps"));
  EXPECT_THAT(clamped.out, Not(HasSubstr("lossless")));
  const Outcome dropped =
      run("convert " + path("back.txt") + " " + path("a.raw") + " --overwrite --time-policy drop");
  EXPECT_THAT(dropped.out, HasSubstr("lost: 1 events older"));
  std::ofstream(path("outside.txt")) << "64 48\n0.1 3 4 1\n0.2 64 4 1\n";
  EXPECT_THAT(run("convert --overwrite " + path("outside.txt") + " " + path("a.raw")).out,
              HasSubstr("lost: 1 events outside the sensor"));
  EXPECT_EQ(run("convert " + path("outside.txt") + " " + path("a.raw") + " --overwrite --out-of-sensor error")
                .exit_code,
            1);
}

TEST_F(Copies, CutByTimeNumberAndRegionHoldsWhatAFilterWould) {
  const std::string original = recording();
  const int64_t from = events_[2'000].t;
  const int64_t to = events_[15'000].t;
  std::vector<Event> expected;
  for (size_t i = 1'000; i < 12'000; ++i) {
    Event e = events_[i];
    if (e.t < from || e.t >= to || e.x < 10 || e.x >= 40 || e.y < 5 || e.y >= 45) continue;
    e.x = static_cast<uint16_t>(e.x - 10);
    e.y = static_cast<uint16_t>(e.y - 5);
    expected.push_back(e);
  }
  ASSERT_GT(expected.size(), 1'000u);
  const Outcome outcome = run(text("cut ", original, " ", path("cut.raw"), " --from ", from, " --to ", to,
                                   " --events 1000:12000 --roi 10,5,30,40 --check"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(read(path("cut.raw")) == expected);
  EXPECT_EQ((*open_events(path("cut.raw")))->sensor(), (SensorSize{30, 40}));

  EXPECT_EQ(run("cut " + original + " " + path("b.raw") + " --events 3:3").exit_code, 2);
  EXPECT_EQ(run("cut " + original + " " + path("b.raw") + " --from 5 --to 5").exit_code, 2);
  EXPECT_EQ(run("cut " + original + " " + path("b.raw") + " --roi 60,0,5,5").exit_code, 2);
  EXPECT_EQ(run("cut " + original + " " + path("b.raw") + " --roi 60,0,5").exit_code, 2);
  EXPECT_EQ(run("cut " + original + " " + path("b.raw") + " --events 19999:").exit_code, 0);
  EXPECT_EQ(read(path("b.raw")).size(), 1u);
}

}  // namespace
}  // namespace scarf::tools
