// Every writer on a disk that is full, from the first byte or later: one line, exit code 1, nothing half
// written.
#include "tests/support/small_disk.h"
#include "tests/tools/every_command.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class FullDisk : public EveryCommand {};

TEST_F(FullDisk, IsOneLineAndNoFileWithEveryWriter) {
  make_inputs();
  const test::SmallDisk disk(path("disk"), size_t{4} << 20);
  if (!disk) GTEST_SKIP() << disk.why();
  size_t failures = 0;
  for (const std::string& command : writers(disk.folder())) {
    disk.leave(SIZE_MAX);
    const auto all = fs::space(disk.folder()).available;
    ASSERT_EQ(run(command).exit_code, 0) << command;
    const auto whole = files_below(disk.folder());
    const auto needed = all - fs::space(disk.folder()).available;
    for (const auto part : {0, 3, 6, 9}) {  // tenths of what is needed
      disk.leave(needed * static_cast<size_t>(part) / 10);
      const Outcome outcome = run_unchecked(SCARF_PROGRAM, command);
      if (outcome.exit_code == 0) {  // pages were rounded
        auto files = files_below(disk.folder());
        files.erase(test::SmallDisk::kFiller);
        EXPECT_EQ(files, whole) << command;
        continue;
      }
      ++failures;
      expect_error(outcome, command + "\n", command);
      EXPECT_THAT(outcome.err, HasSubstr("No space left on device")) << command;
      fs::remove(text(disk.folder(), "/", test::SmallDisk::kFiller));
      EXPECT_EQ(left_behind(disk.folder(), whole), "") << command << " with " << part << "/10";
    }
  }
  EXPECT_GT(failures, 50u);
}

}  // namespace
}  // namespace scarf::tools
