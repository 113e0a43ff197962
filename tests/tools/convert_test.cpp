// scarf convert and scarf cut.
#include <algorithm>
#include <fstream>

#include "scarf/digest/digest.h"
#include "scarf/io/recordings.h"
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
  EXPECT_EQ(run("convert --overwrite " + path("outside.txt") + " " + path("a.raw") + " --out-of-sensor error")
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

// A RAW recording as a camera writes it: triggers among the events, and a header that says where it is from.
const std::vector<std::string> kCamera = {"% date 2024-02-03 04:05:06", "% integrator_name Somebody",
                                          "% serial_number 00000042", "% system_ID 49"};
const std::vector<Trigger> kTriggers = {
    {1'000'500, 0, 1}, {1'050'000, 0, 0}, {1'100'000, 6, 1}, {1'390'000, 6, 0}, {2'000'000, 0, 1}};

class CameraCopies : public Copies {
 protected:
  std::string camera_recording(const std::string& format = "evt3") {
    events_ = random_events(20'000, kSensor);
    std::vector<HeaderLine> header;
    for (const std::string& line : kCamera) {
      const size_t blank = line.find(' ', 2);
      header.push_back({line.substr(2, blank - 2), line.substr(blank + 1)});
    }
    const std::string file = path("camera_" + format + ".raw");
    auto sink = *create_events(file, format, kSensor);
    EXPECT_TRUE(sink->write_header(header).ok());
    auto event = events_.begin();
    for (const Trigger& trigger : kTriggers) {
      const auto behind =
          std::find_if(event, events_.end(), [&](const Event& e) { return e.t >= trigger.t; });
      EXPECT_TRUE(sink->write({event, behind}).ok());
      EXPECT_TRUE(sink->write_triggers({&trigger, 1}).ok());
      event = behind;
    }
    EXPECT_TRUE(sink->write({event, events_.end()}).ok());
    EXPECT_TRUE(sink->finish().ok());
    return file;
  }

  static std::string lines_of(const std::vector<Trigger>& triggers) {
    std::string lines = "t_us,id,value\n";
    for (const Trigger& t : triggers) lines += text(t.t, ",", t.id, ",", int{t.value}, "\n");
    return lines;
  }

  void expect_camera(const std::string& file) {
    const std::string content = content_of(file);
    const std::string header = content.substr(0, content.find("% end\n"));
    for (const std::string& line : kCamera) EXPECT_THAT(header, HasSubstr(line + "\n")) << file;
  }
};

TEST_F(CameraCopies, KeepTriggersAndHeaderThroughAllVersionsOfRaw) {
  const std::string original = camera_recording();
  const std::string digest = digest_of(events_);
  std::string file = original;
  for (const char* format : {"evt2", "evt21", "evt4", "evt3"}) {
    const std::string copy = path(text("copy_", format));
    const Outcome outcome = run(text("convert ", file, " ", copy, " --check --output-format ", format));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("with 5 triggers and 4 lines of the camera's header\nlossless\n"));
    EXPECT_THAT(outcome.out, HasSubstr("\nevents " + digest + "\n"));
    EXPECT_EQ(run("triggers " + copy).out, lines_of(kTriggers)) << format;
    EXPECT_THAT(run("info " + copy).out, testing::StartsWith(text("format:            ", format, "\n")));
    expect_camera(copy);
    file = copy;
  }
}

TEST_F(CameraCopies, KeepTheVersionOfRaw) {
  for (const char* format : {"evt2", "evt21", "evt3", "evt4"}) {
    const std::string original = camera_recording(format);
    for (const std::string job : {"convert ", "cut "}) {
      const std::string copy = path(text("copy_", format, ".raw"));
      std::filesystem::remove(copy);
      ASSERT_EQ(run(job + original + " " + copy).exit_code, 0);
      EXPECT_TRUE(read(copy) == events_) << format;
      EXPECT_EQ((*open_events(copy))->format(), format) << job;
      EXPECT_EQ(run("triggers " + copy).out, lines_of(kTriggers)) << job << format;
    }
    ASSERT_EQ(run("convert " + original + " " + path("other.raw") + " --output-format evt3").exit_code, 0);
    EXPECT_EQ((*open_events(path("other.raw")))->format(), "evt3");
    std::filesystem::remove(path("other.raw"));
  }
  ASSERT_EQ(run("convert " + recording(100) + " " + path("text.raw")).exit_code, 0);
  EXPECT_EQ((*open_events(path("text.raw")))->format(), "evt3");
}

TEST_F(CameraCopies, TellWhatTheFormatHasNoRoomFor) {
  const std::string original = camera_recording();
  for (const FormatInfo& format : formats()) {
    if (!format.written) continue;
    const std::string copy = path("lossy." + format.name);
    const Outcome outcome = run("convert " + original + " " + copy + " --output-format " + format.name);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string triggers = text("not copied: 5 triggers; ", format.name, " has no room for them");
    const std::string header =
        "not copied: the camera's header (date, integrator_name, serial_number, system_ID); ";
    EXPECT_EQ(outcome.out.find(triggers) == std::string::npos, format.writes_triggers) << outcome.out;
    EXPECT_EQ(outcome.out.find(header) == std::string::npos, format.writes_header) << outcome.out;
    EXPECT_EQ(outcome.out.find("lossless") != std::string::npos,
              format.writes_triggers && format.writes_header);
  }
  expect_camera(path("lossy.dat"));
  // What a pipe may hold beside the events is told, too.
  const Outcome piped = run("convert - " + path("piped.raw") + " <" + original);
  EXPECT_EQ(piped.exit_code, 0);
  EXPECT_THAT(piped.out, HasSubstr("not copied: triggers, if there are any: a pipe"));
  EXPECT_THAT(piped.out, Not(HasSubstr("lossless")));
  expect_camera(path("piped.raw"));
}

TEST_F(CameraCopies, TriggersThatAFormatCannotHoldAreCounted) {
  const std::string original = path("inputs.raw");
  {
    auto sink = *create_events(original, "evt2", kSensor);
    const std::vector<Trigger> triggers = {{5, 31, 1}, {6, 3, 1}, {7, 16, 0}};
    ASSERT_TRUE(sink->write_triggers(triggers).ok());
    ASSERT_TRUE(sink->write(events_at({10, 20})).ok());
    ASSERT_TRUE(sink->finish().ok());
  }
  const Outcome outcome = run("convert " + original + " " + path("a.raw") + " --output-format evt3");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("lost: 2 triggers, the first one: "));
  EXPECT_EQ(run("triggers " + path("a.raw")).out, "t_us,id,value\n6,3,1\n");
  EXPECT_EQ(run("convert " + original + " " + path("b.raw") + " --output-format evt3 --strict").exit_code, 1);
  // The first event has the time 0 then, and triggers before it have none.
  const Outcome shifted = run("convert " + original + " " + path("c.raw") + " --time-shift first-event");
  EXPECT_THAT(shifted.out, HasSubstr("lost: 3 triggers, the first one: "));
}

TEST_F(CameraCopies, TriggersAreShiftedWithTheEvents) {
  const std::string original = camera_recording();
  const Outcome outcome =
      run("convert " + original + " " + path("a.raw") + " --check --time-shift first-event");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<Trigger> shifted = kTriggers;
  for (Trigger& t : shifted) t.t -= events_.front().t;
  EXPECT_EQ(run("triggers " + path("a.raw")).out, lines_of(shifted));
}

TEST_F(CameraCopies, TriggersOutOfOrderArePutInOrder) {
  const std::string original = path("order.raw");
  {
    std::ofstream file(original, std::ios::binary);
    file << "% evt 2.0\n% geometry 64x48\n% end\n";
    // Triggers at 67 and 65, events at 66 and 68.
    for (const uint32_t word : {0x80000001u, 0xA0C00001u, 0xA0400100u, 0x10800000u, 0x11000000u}) {
      for (int i = 0; i < 4; ++i) file.put(static_cast<char>(word >> (8 * i)));
    }
  }
  const Outcome outcome = run("convert " + original + " " + path("a.raw") + " --check");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("changed: 1 triggers"));
  EXPECT_EQ(run("triggers " + path("a.raw")).out, "t_us,id,value\n65,1,0\n67,0,1\n");
}

TEST_F(CameraCopies, CutsTriggersAsEvents) {
  const std::string original = camera_recording();
  const std::string cut = path("cut.raw");
  const auto triggers_of_cut = [&](const std::string& options) {
    std::filesystem::remove(cut);
    const Outcome outcome = run("cut " + original + " " + cut + " --check " + options);
    EXPECT_EQ(outcome.exit_code, 0) << options << outcome.err;
    expect_camera(cut);
    return run("triggers " + cut).out;
  };
  EXPECT_EQ(triggers_of_cut("--from 1050000 --to 1390000"), lines_of({kTriggers[1], kTriggers[2]}));
  EXPECT_EQ(triggers_of_cut("--roi 3,3,2,2"), lines_of(kTriggers));
  // Parts by number of events have each trigger once.
  const auto index = [&](int64_t t) {
    return std::find_if(events_.begin(), events_.end(), [&](const Event& e) { return e.t >= t; }) -
           events_.begin();
  };
  const auto a = index(1'050'000);
  EXPECT_EQ(triggers_of_cut(text("--events :", a)), lines_of({kTriggers[0]}));
  EXPECT_EQ(triggers_of_cut(text("--events ", a, ":")),
            lines_of({kTriggers[1], kTriggers[2], kTriggers[3], kTriggers[4]}));
}

TEST_F(CameraCopies, CutTakesTimesWithUnitsAndRelativeToTheFirstEvent) {
  const std::string original = camera_recording();
  const int64_t first = events_.front().t;
  const auto between = [&](int64_t from, int64_t to) {
    std::vector<Event> expected;
    for (const Event& e : events_) {
      if (e.t >= from && e.t < to) expected.push_back(e);
    }
    return expected;
  };
  const struct {
    const char* options;
    int64_t from, to;
  } cases[] = {
      {"--from 1.1s --to 1200ms", 1'100'000, 1'200'000},
      {"--from 1100000 --to 1200000us", 1'100'000, 1'200'000},
      {"--from 1.1s", 1'100'000, INT64_MAX},
      {"--from +0.1s --to +200ms", first + 100'000, first + 200'000},
      {"--from +50000 --to 1.2s", first + 50'000, 1'200'000},
      {"--to +1us", first, first + 1},
      {"--from -1s --to 1100.5ms", -1'000'000, 1'100'500},
  };
  for (const auto& c : cases) {
    std::filesystem::remove(path("cut.raw"));
    const Outcome outcome = run("cut " + original + " " + path("cut.raw") + " " + c.options);
    EXPECT_EQ(outcome.exit_code, 0) << c.options << outcome.err;
    const auto expected = between(c.from, c.to);
    EXPECT_GT(expected.size(), 0u) << c.options;
    EXPECT_TRUE(read(path("cut.raw")) == expected) << c.options;
  }
  for (const std::string options : {"--from 1.5", "--from 1.5x", "--from 1s2", "--from s", "--from +",
                                    "--from +-1s", "--from 0.5us", "--from nan", "--from 99999999999999s",
                                    "--from 2s --to 1s", "--from +2s --to +1s", "--from +2s --to 1s"}) {
    const Outcome outcome = run("cut " + original + " " + path("refused.raw") + " " + options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_FALSE(std::filesystem::exists(path("refused.raw"))) << options;
  }
}

}  // namespace
}  // namespace scarf::tools
