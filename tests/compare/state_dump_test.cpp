#include "compare/state_dump.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scarf/digest/digest.h"
#include "scarf/reference/reference.h"
#include "tests/tools/event_fixtures.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;

constexpr SensorSize kSensor{40, 30};
constexpr size_t kHeaderBytes = 60;

Snapshot some_state(size_t events = 3000) {
  const auto scarf = *make_reference_scarf(*make_geometry(Preset::light, kSensor));
  EXPECT_TRUE(scarf->push(random_events(events, kSensor)).ok());
  return *scarf->snapshot().wait();
}

// The first error of reading a whole dump; empty if there is none.
std::string error_of(const std::string& path) {
  auto dump = StateDump::open(path);
  if (!dump) return dump.error().message;
  for (int64_t patch = 0; patch < dump->geometry().patches(); ++patch) {
    if (const auto p = dump->next(); !p) return p.error().message;
  }
  const auto end = dump->finish();
  return end ? "" : end.error().message;
}

TEST(StateDump, EveryPatchComesBack) {
  const TemporaryFolder folder;
  const Snapshot snapshot = some_state();
  ASSERT_TRUE(write_state_dump(folder.path("dump"), snapshot, OutputRule()).ok());
  auto dump = StateDump::open(folder.path("dump"));
  ASSERT_TRUE(dump.ok()) << dump.error().message;
  EXPECT_EQ(dump->geometry(), snapshot.geometry);
  for (size_t patch = 0; patch < snapshot.totals.size(); ++patch) {
    const auto p = dump->next();
    ASSERT_TRUE(p.ok()) << p.error().message;
    EXPECT_EQ(p->total, snapshot.totals[patch]);
    const auto filled = snapshot.ring(patch).first(snapshot.filled(patch));
    EXPECT_EQ(p->slots, std::vector<Event>(filled.begin(), filled.end()));
  }
  EXPECT_TRUE(dump->finish().ok());
}

TEST(StateDump, HoldsTheHashedBytesBehindItsHeader) {
  const TemporaryFolder folder;
  const Snapshot snapshot = some_state();
  ASSERT_TRUE(write_state_dump(folder.path("dump"), snapshot, OutputRule()).ok());
  const std::string content = content_of(folder.path("dump"));
  ASSERT_EQ(content.substr(0, 8), "SCARFST1");
  EXPECT_EQ(content.substr(8, 8), std::string("\x28\0\0\0\x1e\0\0\0", 8));  // 40, 30
  Digest digest;
  digest.add(
      {reinterpret_cast<const uint8_t*>(content.data()) + kHeaderBytes, content.size() - kHeaderBytes});
  EXPECT_EQ(digest.hex(), state_digest(snapshot));
}

TEST(StateDump, NegativeOriginsAndTimesComeBack) {
  const TemporaryFolder folder;
  const auto scarf = *make_reference_scarf({{40, 8, -3, 6, 2, 2}, {30, 8, -5, 5, 2, 2}, 4});
  ASSERT_TRUE(scarf->push(events_at({-5, -4, 7})).ok());
  const Snapshot snapshot = *scarf->snapshot().wait();
  ASSERT_TRUE(write_state_dump(folder.path("dump"), snapshot, OutputRule()).ok());
  auto dump = StateDump::open(folder.path("dump"));
  ASSERT_TRUE(dump.ok());
  EXPECT_EQ(dump->geometry(), snapshot.geometry);
  EXPECT_EQ(dump->next()->slots, events_at({-5, -4, 7}));
}

TEST(StateDump, DamageIsNamed) {
  const TemporaryFolder folder;
  const std::string path = folder.path("dump");
  ASSERT_TRUE(write_state_dump(path, some_state(), OutputRule()).ok());
  const std::string good = content_of(path);
  EXPECT_EQ(error_of(path), "");

  EXPECT_THAT(error_of(folder.path("missing")), HasSubstr("cannot open"));
  write_text(path, "");
  EXPECT_THAT(error_of(path), HasSubstr("is no state dump"));
  std::string magic = good;
  magic[0] = 'X';
  write_text(path, magic);
  EXPECT_THAT(error_of(path), HasSubstr("is no state dump"));
  write_text(path, good.substr(0, kHeaderBytes + 4));
  EXPECT_THAT(error_of(path), HasSubstr("ends within patch 0"));
  write_text(path, good.substr(0, good.size() - 1));
  EXPECT_THAT(error_of(path), HasSubstr("ends within patch"));
  write_text(path, good + "x");
  EXPECT_THAT(error_of(path), HasSubstr("goes on behind its last patch"));

  std::string header = good;
  header[kHeaderBytes - 1] = '\x7f';  // the capacity
  write_text(path, header);
  EXPECT_THAT(error_of(path), HasSubstr("illegal header: capacity"));
  std::string flag = good;
  flag[kHeaderBytes + 8 + 5] ^= 1;  // patch 0 slot 0
  write_text(path, flag);
  EXPECT_THAT(error_of(path), HasSubstr("patch 0 slot 0 has an active flag"));
}

TEST(StateDump, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const auto written = write_state_dump("/dev/full", some_state(), OutputRule());
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().code, ErrorCode::io);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace scarf::tools
