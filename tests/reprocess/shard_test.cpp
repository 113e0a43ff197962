#include "reprocess/shard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "reprocess/sample.h"

namespace scarf::reprocess {

namespace {

Environment fixed(const std::map<std::string, std::string>& variables) {
  return [variables](const char* name) -> std::optional<std::string> {
    const auto at = variables.find(name);
    return at == variables.end() ? std::nullopt : std::optional(at->second);
  };
}

TEST(Shard, PartsAreDisjointAndComplete) {
  for (const uint64_t count : {1u, 2u, 7u, 64u}) {
    std::set<uint64_t> used;
    for (int i = 0; i < 500; ++i) {
      const std::string path = "folder/" + std::to_string(i) + ".raw";
      int takers = 0;
      for (uint64_t index = 1; index <= count; ++index) {
        if (!Shard{index, count, ""}.takes(path)) continue;
        ++takers;
        used.insert(index);
      }
      EXPECT_EQ(takers, 1) << path << " of " << count;
    }
    EXPECT_EQ(used.size(), count);
  }
}

TEST(Shard, WordsAreCheckedByTheirRange) {
  EXPECT_EQ(parse_shard("2/3")->index, 2u);
  for (const char* word : {"", "1", "0/3", "4/3", "1/0", "a/b", "1/3/5", "-1/3", "1/1000001"}) {
    ASSERT_FALSE(parse_shard(word).ok()) << word;
    EXPECT_EQ(parse_shard(word).error().code, ErrorCode::illegal_parameter);
  }
}

TEST(Shard, OfASlurmArrayCountsFromItsLowestTask) {
  const auto shard = shard_from_environment(fixed({{"SLURM_ARRAY_TASK_ID", "7"},
                                                   {"SLURM_ARRAY_TASK_MIN", "3"},
                                                   {"SLURM_ARRAY_TASK_STEP", "2"},
                                                   {"SLURM_ARRAY_TASK_COUNT", "4"}}),
                                            true);
  ASSERT_TRUE(shard.ok());
  EXPECT_EQ(shard->index, 3u);
  EXPECT_EQ(shard->count, 4u);
}

TEST(Shard, OfRanksCountsFromZero) {
  const auto open_mpi =
      shard_from_environment(fixed({{"OMPI_COMM_WORLD_RANK", "3"}, {"OMPI_COMM_WORLD_SIZE", "4"}}), true);
  EXPECT_EQ(open_mpi->index, 4u);
  const auto pmi = shard_from_environment(fixed({{"PMI_RANK", "0"}, {"PMI_SIZE", "2"}}), true);
  EXPECT_EQ(pmi->index, 1u);
  EXPECT_EQ(pmi->count, 2u);
  EXPECT_EQ(shard_from_environment(fixed({{"PMI_RANK", "0"}, {"PMI_SIZE", "2"}}), false)->count, 1u);
}

TEST(Shard, RanksCutTheShareOfAnArrayTask) {
  std::set<uint64_t> indices;
  for (const char* task : {"0", "1", "2"}) {
    for (const char* rank : {"0", "1"}) {
      const auto shard = shard_from_environment(fixed({{"SLURM_ARRAY_TASK_ID", task},
                                                       {"SLURM_ARRAY_TASK_COUNT", "3"},
                                                       {"PMI_RANK", rank},
                                                       {"PMI_SIZE", "2"}}),
                                                true);
      EXPECT_EQ(shard->count, 6u);
      indices.insert(shard->index);
    }
  }
  EXPECT_THAT(indices, testing::ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(Shard, RefusesVariablesThatMakeNoRow) {
  // Tasks 1, 5 and 6: nobody would take the share of a second and a third.
  EXPECT_FALSE(shard_from_environment(fixed({{"SLURM_ARRAY_TASK_ID", "6"},
                                             {"SLURM_ARRAY_TASK_MIN", "1"},
                                             {"SLURM_ARRAY_TASK_COUNT", "3"}}),
                                      true)
                   .ok());
  EXPECT_FALSE(shard_from_environment(fixed({{"PMI_RANK", "2"}, {"PMI_SIZE", "2"}}), true).ok());
  EXPECT_FALSE(shard_from_environment(fixed({{"PMI_RANK", "x"}, {"PMI_SIZE", "2"}}), true).ok());
  EXPECT_EQ(shard_from_environment(fixed({}), true)->count, 1u);
}

TEST(Sample, IsThatShareAndFollowsTheSeed) {
  std::vector<Job> jobs(40);
  for (size_t i = 0; i < jobs.size(); ++i) jobs[i].relative = std::to_string(i);
  const auto names = [](const std::vector<Job>& some) {
    std::set<std::string> out;
    for (const Job& job : some) out.insert(job.relative);
    return out;
  };
  EXPECT_EQ(names(sample(jobs, 0.25, 1)).size(), 10u);
  EXPECT_EQ(names(sample(jobs, 0.001, 1)).size(), 1u);
  EXPECT_EQ(names(sample(jobs, 1, 1)).size(), 40u);
  EXPECT_EQ(names(sample(jobs, 0.25, 1)), names(sample({jobs.rbegin(), jobs.rend()}, 0.25, 1)));
  EXPECT_NE(names(sample(jobs, 0.25, 1)), names(sample(jobs, 0.25, 2)));
  EXPECT_TRUE(sample({}, 1, 1).empty());
}

}  // namespace
}  // namespace scarf::reprocess
