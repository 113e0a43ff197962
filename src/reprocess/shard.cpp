#include "reprocess/shard.h"

#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>

#include "core/parse.h"
#include "core/text.h"
#include "scarf/digest/digest.h"

namespace scarf::reprocess {
namespace {

constexpr uint64_t kMaxShards = 1'000'000;

// A whole number out of a variable; nullopt if it is not set.
Result<std::optional<uint64_t>> number(const Environment& environment, const char* name) {
  const auto word = environment(name);
  if (!word) return std::optional<uint64_t>();
  const auto value = parse_integer<uint64_t>(*word);
  if (!value) {
    return Error{ErrorCode::bad_input, text("the environment variable ", name, " is '", *word,
                                            "', which is no number; name a Shard")};
  }
  return value;
}

Result<std::optional<Shard>> rank_of(const Environment& environment, const char* rank_name,
                                     const char* size_name) {
  const auto rank = number(environment, rank_name);
  if (!rank) return rank.error();
  const auto size = number(environment, size_name);
  if (!size) return size.error();
  if (!*rank || !*size) return std::optional<Shard>();
  if (**rank >= **size) {
    return Error{ErrorCode::bad_input,
                 text(rank_name, " is ", **rank, ", but ", size_name, " is ", **size, "; name a Shard")};
  }
  return std::optional(Shard{**rank + 1, **size, rank_name});
}

Result<std::optional<Shard>> array_task(const Environment& environment) {
  const char* const names[] = {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
                               "SLURM_ARRAY_TASK_STEP"};
  std::optional<uint64_t> values[4];
  for (size_t i = 0; i < 4; ++i) {
    const auto value = number(environment, names[i]);
    if (!value) return value.error();
    values[i] = *value;
  }
  const auto& [id, count, lowest, step] = values;
  if (!id || !count) return std::optional<Shard>();
  const uint64_t first = lowest.value_or(0);
  const uint64_t stride = std::max<uint64_t>(step.value_or(1), 1);
  const uint64_t index = *id < first ? *count : (*id - first) / stride;
  if (index >= *count || (*id - first) % stride != 0) {
    return Error{ErrorCode::bad_input,
                 text("the Slurm array has ", *count, " tasks, and its task ", *id, " is none of a row from ",
                      first, "; use --array=0-", *count - 1, ", or name a Shard")};
  }
  return std::optional(Shard{index + 1, *count, names[0]});
}

}  // namespace

bool Shard::takes(const std::string& relative) const {
  if (count == 1) return true;
  Digest digest;
  digest.add(std::span(reinterpret_cast<const uint8_t*>(relative.data()), relative.size()));
  const std::string hex = digest.hex();
  uint64_t hash = 0;
  for (const char c : std::string_view(hex).substr(0, 16)) {
    hash = hash << 4 | static_cast<uint64_t>(c <= '9' ? c - '0' : c - 'a' + 10);
  }
  return hash % count == index - 1;
}

Result<Shard> parse_shard(const std::string& word) {
  const std::string_view view = word;
  const size_t slash = view.find('/');
  if (slash != view.npos) {
    const auto index = parse_integer<uint64_t>(view.substr(0, slash));
    const auto count = parse_integer<uint64_t>(view.substr(slash + 1));
    if (index && count && *index >= 1 && *index <= *count && *count <= kMaxShards) {
      return Shard{*index, *count, "the request"};
    }
  }
  return Error{ErrorCode::illegal_parameter,
               text("'", word, "' is no shard; the first of four is 1/4, the last is 4/4")};
}

Environment process_environment() {
  return [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') return std::nullopt;
    return value;
  };
}

Result<std::optional<Shard>> mpi_shard(const Environment& environment) {
  auto open_mpi = rank_of(environment, "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE");
  if (!open_mpi || *open_mpi) return open_mpi;
  return rank_of(environment, "PMI_RANK", "PMI_SIZE");
}

Result<Shard> shard_from_environment(const Environment& environment, bool split_ranks) {
  const auto array = array_task(environment);
  if (!array) return array.error();
  const auto rank = split_ranks ? mpi_shard(environment) : std::optional<Shard>();
  if (!rank) return rank.error();
  if (!*array && !*rank) return Shard{};
  if (!*array) return **rank;
  if (!*rank) return **array;
  // Ranks within the tasks of an array: each task's share is cut again.
  return Shard{((*array)->index - 1) * (*rank)->count + (*rank)->index, (*array)->count * (*rank)->count,
               text((*array)->origin, " and ", (*rank)->origin)};
}

}  // namespace scarf::reprocess
