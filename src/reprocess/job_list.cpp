#include "reprocess/job_list.h"

#include <sys/stat.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "core/text.h"
#include "output/owned_files.h"
#include "reprocess/manifest.h"
#include "reprocess/result_place.h"

namespace scarf::reprocess {
namespace {

namespace fs = std::filesystem;

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

uint64_t size_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    const uint64_t size = fs::file_size(path, error);
    return error ? 0 : size;
  }
  uint64_t sum = 0;
  for (fs::recursive_directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) sum += entry->file_size(ignored);
  }
  return sum;
}

// Whether a folder is one job: a recording, good or broken, or something to be left out; rather than a folder
// of recordings.
bool is_one_job(const fs::path& folder, const SettingWords& settings) {
  const auto options = parse_settings(settings);
  if (!options) return false;
  if (options->skip) return true;
  const auto source = open_events(folder.string(), options->stream.read);
  if (source) return true;
  // A format that is named for all files says nothing of a folder.
  return source.error().code == ErrorCode::bad_input && options->stream.read.format.empty();
}

// What a folder is, whatever leads to it; nullopt if that cannot be told.
std::optional<std::pair<dev_t, ino_t>> identity_of(const fs::path& folder) {
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

// Every folder is entered once, however many links lead to it, so links in circles and links that multiply
// make no work. Links wait until the folders that lie where they are named are known.
class FolderWalk {
 public:
  FolderWalk(const Recipe& recipe, const std::string& out) : recipe_(recipe), out_(identity_of(out)) {}

  JobList walk(const fs::path& root) {
    std::error_code error;
    const std::string name = fs::weakly_canonical(root, error).filename().string();
    root_ = identity_of(root);
    if (root_) entered_.emplace(*root_, name);
    if (is_one_job(root, recipe_.for_recording(name))) {
      add_job(name, root);
    } else {
      enter(root, "");
    }
    for (; !links_.empty(); links_.pop_front()) {
      const auto [folder, relative] = links_.front();
      visit_folder(folder, relative);
    }
    return std::move(list_);
  }

 private:
  void settle(const std::string& relative, Status status, const std::string& message) {
    Outcome outcome;
    outcome.relative = relative;
    outcome.status = status;
    outcome.message = message;
    outcome.code = ErrorCode::io;
    list_.settled.push_back(outcome);
  }

  void add_job(const std::string& relative, const fs::path& path) {
    list_.jobs.push_back({relative, path.string(), recipe_.for_recording(relative), false, size_of(path)});
  }

  void enter(const fs::path& folder, const std::string& relative) {
    std::vector<fs::path> entries;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      entries.push_back(entry->path());
    }
    if (error) settle(relative, Status::failed, text("cannot list ", folder.string(), ": ", error.message()));
    std::sort(entries.begin(), entries.end());
    const auto ours = results_in(folder, entries);
    for (const fs::path& entry : entries) {
      const std::string name = entry.filename().string();
      if (is_list_name(name) || ours.contains(name)) continue;
      visit(entry, relative.empty() ? name : text(relative, "/", name));
    }
  }

  // Where results go beside their recordings they are no recordings themselves.
  std::set<std::string> results_in(const fs::path& folder, const std::vector<fs::path>& entries) const {
    std::set<std::string> ours;
    if (root_ != out_) return ours;
    for (const fs::path& list : entries) {
      if (!is_list_name(list.filename().string())) continue;
      const auto owned = OwnedFiles::read(folder.string(), list.filename().string());
      if (!owned) continue;
      for (const fs::path& entry : entries) {
        if (owned->owns(entry.filename().string())) ours.insert(entry.filename().string());
      }
    }
    return ours;
  }

  void visit(const fs::path& entry, const std::string& relative) {
    if (is_temporary_name(entry.filename().string())) {
      return settle(relative, Status::skipped,
                    "an unfinished output of scarf, left by a run that was killed");
    }
    std::error_code error;
    const fs::file_status status = fs::status(entry, error);
    if (status.type() == fs::file_type::not_found || status.type() == fs::file_type::none) {
      const std::string why = error ? error.message() : "it is a link to nothing";
      return settle(relative, Status::failed, text("cannot open ", entry.string(), ": ", why));
    }
    if (status.type() == fs::file_type::directory) {
      if (fs::is_symlink(entry, error)) return links_.emplace_back(entry, relative), void();
      return visit_folder(entry, relative);
    }
    if (looks_unfinished(relative)) return settle_unfinished(relative);
    if (status.type() != fs::file_type::regular) {
      return settle(relative, Status::skipped, "neither a file nor a folder");
    }
    add_job(relative, entry);
  }

  void visit_folder(const fs::path& folder, const std::string& relative) {
    const auto identity = identity_of(folder);
    if (!identity) return settle(relative, Status::failed, text("cannot open ", folder.string()));
    if (identity == out_) return;
    if (looks_unfinished(relative)) return settle_unfinished(relative);
    const auto [first, fresh] = entered_.emplace(*identity, relative);
    if (!fresh) {
      return settle(relative, Status::skipped, text("the same folder as ", first->second, ", listed there"));
    }
    if (is_one_job(folder, recipe_.for_recording(relative))) return add_job(relative, folder);
    enter(folder, relative);
  }

  void settle_unfinished(const std::string& relative) {
    settle(relative, Status::skipped,
           text("its name ends in ", kUnfinishedSuffix, ", which marks unfinished results; rename it"));
  }

  const Recipe& recipe_;
  const std::optional<std::pair<dev_t, ino_t>> out_;
  std::optional<std::pair<dev_t, ino_t>> root_;
  std::map<std::pair<dev_t, ino_t>, std::string> entered_;  // folders, and where they are listed
  std::deque<std::pair<fs::path, std::string>> links_;
  JobList list_;
};

// Where the results of a listed recording go: as it is listed, or for a path that leads out of the list's
// folder, as the whole path without its root.
std::string mirrored(const fs::path& path, const fs::path& folder) {
  const auto leads_out = [](const fs::path& p) { return p.is_absolute() || *p.begin() == ".."; };
  fs::path relative = path.lexically_normal();
  std::error_code ignored;
  if (leads_out(relative)) {
    relative = fs::absolute(folder / path, ignored).lexically_normal().relative_path();
  }
  const std::string name = relative.generic_string();
  return name.ends_with('/') ? name.substr(0, name.size() - 1) : name;
}

Result<JobList> from_manifest(const std::string& input, const Recipe& recipe) {
  const auto entries = read_manifest(input);
  if (!entries) return entries.error();
  const fs::path folder = fs::path(input).parent_path();
  JobList list;
  for (const Listed& entry : *entries) {
    Job job;
    job.relative = mirrored(entry.as.empty() ? entry.path : entry.as, folder);
    job.path = (folder / entry.path).string();
    job.settings = recipe.for_recording(job.relative);
    lay_over(job.settings, entry.settings);
    job.listed = true;
    std::error_code ignored;
    const fs::file_status status = fs::status(job.path, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) {
      return illegal(text(input, " line ", entry.line, ": ", entry.path, " is neither a file nor a folder"));
    }
    job.bytes = size_of(job.path);
    if (const auto options = parse_settings(job.settings); !options) {
      return illegal(text(input, " line ", entry.line, ": ", options.error().message));
    }
    if (looks_unfinished(job.relative) || job.relative.empty() || job.relative == ".") {
      return illegal(text(input, " line ", entry.line, ": results of ", entry.path,
                          " need another name; give one with as=NAME that does not end in ",
                          kUnfinishedSuffix));
    }
    list.jobs.push_back(std::move(job));
  }
  return list;
}

// Settings of a folder's recordings can be wrong by the rules that meet in them.
Result<void> check_settings(const std::vector<Job>& jobs) {
  std::set<SettingWords> good;
  for (const Job& job : jobs) {
    if (!good.insert(job.settings).second) continue;
    const auto options = parse_settings(job.settings);
    if (!options) return illegal(text("the settings of ", job.relative, ": ", options.error().message));
  }
  return {};
}

// Results are moved over what is in their place, so no two things may have the same one.
Result<void> check_places(const std::vector<Job>& jobs) {
  std::map<std::string, std::string> places;  // and whose
  std::set<std::string> folders;
  for (const Job& job : jobs) {
    std::vector<std::string> mine = {text(job.relative, kRecordSuffix),
                                     text(job.relative, kUnfinishedSuffix)};
    for (const std::string& suffix : result_suffixes(job.settings)) {
      mine.push_back(job.relative + suffix.substr(0, suffix.size() - (suffix.ends_with('/') ? 1 : 0)));
    }
    for (const std::string& place : mine) {
      const auto [at, fresh] = places.try_emplace(place, job.relative);
      if (!fresh) {
        return illegal(text("the results of ", at->second, " and ", job.relative, " would both be ", place,
                            "; give one of them another name, in a list with as=NAME"));
      }
    }
    for (fs::path folder = fs::path(job.relative).parent_path(); !folder.empty();
         folder = folder.parent_path()) {
      if (!folders.insert(folder.generic_string()).second) break;
    }
  }
  for (const auto& [place, owner] : places) {
    if (!folders.contains(place)) continue;
    return illegal(text("the result ", place, " of ", owner,
                        " would be where the results of a folder go; choose another output"));
  }
  return {};
}

}  // namespace

Result<JobList> list_jobs(const std::string& input, const Recipe& recipe, const std::string& out) {
  std::error_code error;
  const fs::file_status status = fs::status(input, error);
  if (!fs::exists(status)) {
    return Error{ErrorCode::io, text("cannot open ", input, ": ",
                                     error ? error.message() : "there is no such file or folder")};
  }
  const bool folder = fs::is_directory(status);
  auto list = folder ? FolderWalk(recipe, out).walk(input) : from_manifest(input, recipe);
  if (!list) return list;
  if (list->jobs.empty() && list->settled.empty()) {
    return Error{ErrorCode::bad_input, text(input, " names no recordings")};
  }
  std::sort(list->jobs.begin(), list->jobs.end(),
            [](const Job& a, const Job& b) { return a.relative < b.relative; });
  if (auto r = check_settings(list->jobs); !r) return r.error();
  if (auto r = check_places(list->jobs); !r) return r.error();
  return list;
}

}  // namespace scarf::reprocess
