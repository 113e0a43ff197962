// scarf reprocess: one recipe for all recordings of a folder or of a list.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <thread>

#include "core/text.h"
#include "io/files/new_file.h"
#include "output/frame_writer.h"
#include "output/owned_files.h"
#include "reprocess/job_list.h"
#include "reprocess/mpi_crew.h"
#include "reprocess/recipe.h"
#include "reprocess/result_place.h"
#include "reprocess/run.h"
#include "reprocess/sample.h"
#include "reprocess/shard.h"
#include "reprocess/summary.h"
#include "reprocess/terminal_display.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/file_options.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

using namespace reprocess;  // NOLINT(google-build-using-namespace): this file is its front
namespace fs = std::filesystem;

constexpr size_t kMostJobsByDefault = 4;  // beyond, one device and one disk seldom gain
constexpr size_t kMostJobs = 256;

struct ReprocessOptions {
  std::string input;
  std::string output;
  std::string recipe;
  std::optional<uint64_t> jobs;
  std::optional<Shard> shard;
  bool resume = false;
  bool keep_going = false;
  bool json = false;
  bool overwrite = false;
  std::optional<uint64_t> max_frames;
  bool allow_empty = false;
  std::optional<double> verify;
  std::optional<uint64_t> seed;
  StreamRequest work;  // batches and device
};

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

Result<uint64_t> parse_jobs(const std::string& word) {
  const auto jobs = parse_integer<uint64_t>(word);
  if (jobs && *jobs >= 1 && *jobs <= kMostJobs) return *jobs;
  return illegal(text("'", word, "' is not a whole number from 1 to ", kMostJobs));
}

Result<double> parse_share(const std::string& word) {
  const auto share = parse_integer<double>(word);
  if (share && *share > 0 && *share <= 1) return *share;
  return illegal(text("'", word, "' is not a number above 0, up to 1"));
}

Result<Recipe> recipe_of(const ReprocessOptions& options) {
  return options.recipe.empty() ? Result<Recipe>(default_recipe()) : read_recipe(options.recipe);
}

// The recordings of this shard.
Result<JobList> share_of(const ReprocessOptions& options, const Recipe& recipe, const Shard& shard) {
  auto list = list_jobs(options.input, recipe, options.output);
  if (!list) return list;
  std::erase_if(list->jobs, [&](const Job& job) { return !shard.takes(job.relative); });
  std::erase_if(list->settled, [&](const Outcome& o) { return !shard.takes(o.relative); });
  for (Job& job : list->jobs) {
    if (options.allow_empty) job.settings["allow-empty"] = {"true"};
  }
  if (options.max_frames) {
    for (Job& job : list->jobs) job.settings["max-frames"] = {text(*options.max_frames)};
  }
  return list;
}

// Inexact representations cannot be compared by digests.
Result<void> check_comparable(const std::vector<Job>& jobs) {
  for (const Job& job : jobs) {
    const std::string& name = job.settings.at("representation").front();
    for (const RepresentationInfo& info : representations()) {
      if (info.name != name || info.exact) continue;
      return illegal(text("--verify compares digests, and pictures of ", name,
                          " may differ in the last bit; use scarf verify on single recordings"));
    }
  }
  return {};
}

// What the run reads: nothing of it may be written to.
OutputRule rule_of(const ReprocessOptions& options, const std::vector<Job>& jobs) {
  OutputRule rule(options.overwrite);
  std::error_code ignored;
  if (!fs::is_directory(options.input, ignored)) rule.add_input(options.input);
  if (!options.recipe.empty()) rule.add_input(options.recipe);
  for (const Job& job : jobs) {
    rule.add_input(job.path, options.output);
    const auto times = job.settings.find("at-times");
    if (times == job.settings.end()) continue;
    for (const std::string& name : times->second) rule.add_input(side_file(name, job.path));
  }
  return rule;
}

// Before anything is written or computed.
Result<void> prepare_output(const ReprocessOptions& options, const std::vector<Job>& jobs,
                            const OutputRule& rule, const std::string& summary) {
  std::error_code error;
  if (fs::weakly_canonical(fs::absolute(options.output, error), error).relative_path().empty()) {
    return illegal(text(options.output, " is the root of the file system; give another folder"));
  }
  if (fs::exists(options.output, error) && !fs::is_directory(options.output, error)) {
    return illegal(text(options.output, " is no folder; give another name"));
  }
  const bool replaces = options.resume || options.overwrite;
  for (const Job& job : jobs) {
    const bool finished = has_record(options.output, job);
    if (finished && !replaces) {
      return illegal(text(options.output, " has results of ", job.relative,
                          " already; continue with --resume, compute them again with --overwrite, or give "
                          "another output"));
    }
    // What is finished may stay; who finds that it has to be computed again checks its place then.
    if (finished && options.resume && is_record(options.output, job)) continue;
    if (auto r = check_place(options.output, job.relative, result_suffixes(job.settings), replaces, rule); !r)
      return r;
  }
  const auto owned = OwnedFiles::read(options.output, list_name_of(summary));
  if (!owned) return owned.error();
  if (auto r = owned->check({summary}, replaces, rule); !r) return r;
  fs::create_directories(options.output, error);
  if (error)
    return Error{ErrorCode::io, text("cannot make the folder ", options.output, ": ", error.message())};
  for (const Job& job : jobs) remove_stale(options.output, job.relative);
  return {};
}

// A run that has just ended beside this one may have written a summary, too.
Result<void> write_summary(const ReprocessOptions& options, const std::string& name, const std::string& json,
                           const OutputRule& rule) {
  auto scratch = ScratchFolder::create((fs::path(options.output) / name).string());
  if (!scratch) return scratch.error();
  if (auto r = write_new_file(scratch->file(name), json); !r) return r;
  return OwnedFiles::replace(options.output, list_name_of(name), *scratch, {name}, /*replace=*/true, rule);
}

size_t threads_of(const ReprocessOptions& options) {
  const size_t cores = std::max(1U, std::thread::hardware_concurrency());
  return options.jobs.value_or(std::min(cores, kMostJobsByDefault));
}

Result<Workplace> workplace_of(const ReprocessOptions& options, const OutputRule& rule) {
  Workplace workplace;
  workplace.rule = rule;
  workplace.machine.batches = options.work.batches;
  workplace.out = options.output;
  workplace.resume = options.resume;
  if (options.work.cpu) return workplace;
  auto context = GpuContext::create(options.work.device);
  if (!context) return context.error();
  workplace.machine.context = *std::move(context);
  return workplace;
}

std::vector<Task> tasks_of(const std::vector<Job>& jobs, Task::Kind kind) {
  std::vector<Task> tasks;
  for (const Job& job : jobs) tasks.push_back({kind, job});
  // The largest first, so that none of them is begun last.
  std::stable_sort(tasks.begin(), tasks.end(),
                   [](const Task& a, const Task& b) { return a.job.bytes > b.job.bytes; });
  return tasks;
}

Result<Checks> check_some(const ReprocessOptions& options, const std::vector<Job>& jobs,
                          const std::vector<Outcome>& outcomes, Crew& crew, Display& display) {
  std::map<std::string, Status> status;
  for (const Outcome& o : outcomes) status[o.relative] = o.status;
  std::vector<Job> finished;
  for (const Job& job : jobs) {
    const Status s = status[job.relative];
    if (s == Status::done || s == Status::kept) finished.push_back(job);
  }
  Checks checks{*options.verify, options.seed.value_or(std::random_device{}()), {}};
  const auto tasks = tasks_of(sample(finished, checks.share, checks.seed), Task::Kind::check);
  auto checked = run(tasks, crew, /*keep_going=*/true, display);
  if (!checked) return checked.error();
  checks.outcomes = *std::move(checked);
  return checks;
}

Result<int> work_through(const ReprocessOptions& options, MpiSession* mpi) {
  const auto start = std::chrono::steady_clock::now();
  const bool split_ranks = mpi == nullptr;
  const auto shard = options.shard ? Result<Shard>(*options.shard)
                                   : shard_from_environment(process_environment(), split_ranks);
  if (!shard) return shard.error();
  const auto recipe = recipe_of(options);
  if (!recipe) return recipe.error();
  auto list = share_of(options, *recipe, *shard);
  if (!list) return list.error();
  if (options.verify) {
    if (auto r = check_comparable(list->jobs); !r) return r.error();
  }
  const OutputRule rule = rule_of(options, list->jobs);
  const std::string summary_file = summary_name(*shard);
  if (auto r = prepare_output(options, list->jobs, rule, summary_file); !r) return r.error();
  const auto workplace = workplace_of(options, rule);
  if (!workplace) return workplace.error();

  Threads threads(threads_of(options), *workplace);
  const std::unique_ptr<Crew> ranks = mpi != nullptr ? mpi->lead(threads) : nullptr;
  Crew& crew = ranks ? *ranks : threads;
  Summary summary{options.input,
                  workplace->machine.name(),
                  *shard,
                  threads_of(options),
                  mpi != nullptr ? mpi->size() : 1,
                  list->settled,
                  std::nullopt,
                  0};
  {
    TerminalDisplay display;
    for (const Outcome& o : list->settled) display.tell(o);
    const bool failed_already = summary.count(Status::failed) > 0 && !options.keep_going;
    const auto tasks = tasks_of(list->jobs, Task::Kind::process);
    auto outcomes = failed_already ? Result<std::vector<Outcome>>(not_tried(tasks))
                                   : run(tasks, crew, options.keep_going, display);
    if (!outcomes) return outcomes.error();
    summary.outcomes.insert(summary.outcomes.end(), outcomes->begin(), outcomes->end());
    if (options.verify) {
      auto checks = check_some(options, list->jobs, *outcomes, crew, display);
      if (!checks) return checks.error();
      summary.checks = *std::move(checks);
    }
  }
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string json = summary_json(summary);
  std::cout << (options.json ? json : summary_table(summary));
  const auto written = write_summary(options, summary_file, json, rule);
  if (!written) return written.error();
  return summary.good() ? 0 : 1;
}

Result<int> serve(const ReprocessOptions& options, MpiSession& mpi) {
  const auto workplace = workplace_of(options, OutputRule(options.overwrite));
  if (!workplace) return workplace.error();
  Threads threads(threads_of(options), *workplace);
  if (auto r = mpi.serve(threads); !r) return r.error();
  return 0;
}

Result<int> reprocess_all(const ReprocessOptions& options) {
  if (options.seed && !options.verify) return illegal("--seed is used by --verify only; leave it out");
  silence_video_messages();
  const auto mpi = MpiSession::start();
  if (!mpi) return mpi.error();
  return *mpi && (*mpi)->rank() > 0 ? serve(options, **mpi) : work_through(options, mpi->get());
}

}  // namespace

void add_reprocess(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("reprocess", "One recipe for all recordings of a folder or list");
  auto options = std::make_shared<ReprocessOptions>();
  add_input_option(*app, "input", options->input, "Folder of recordings, or file that lists recordings")
      ->required();
  add_output_option(*app, "-o,--output", options->output,
                    "Folder for results, a record NAME.json beside those of each recording, and summary.json")
      ->required();
  add_input_option(*app, "--recipe", options->recipe,
                   "TOML file: what is asked of the recordings; default: SCARF, one picture at the end");
  add_parsed_option(*app, "--jobs", options->jobs, parse_jobs,
                    text("Recordings at a time, default: as many as cores, up to ", kMostJobsByDefault));
  add_parsed_option(*app, "--shard", options->shard, parse_shard,
                    "i/n: the i-th of n parts; default: as Slurm arrays and MPI launchers say");
  app->add_flag("--resume", options->resume, "Keep what an earlier run has finished");
  app->add_flag("--keep-going", options->keep_going, "Go on after a recording that failed");
  add_parsed_option(
      *app, "--max-frames", options->max_frames, parse_positive,
      "Most frames of a rate in a row without an event between them, default 10000; instead of what "
      "the recipe says");
  add_settings(*app, empty_settings(options->allow_empty));
  add_parsed_option(*app, "--verify", options->verify, parse_share,
                    "Compute this share of the recordings, 0 to 1, again on the CPU reference and compare");
  add_parsed_option(*app, "--seed", options->seed, parse_whole<uint64_t>,
                    "Which recordings --verify takes; default: random");
  app->add_flag("--json", options->json, "The summary as JSON");
  add_settings(*app, work_settings(options->work));
  app->callback([&command, app, options] {
    command.run = [app, options] {
      options->overwrite = output_rule(*app).overwrite();
      return reprocess_all(*options);
    };
  });
}

}  // namespace scarf::tools
