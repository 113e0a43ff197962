#include "output/owned_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "core/text.h"
#include "io/files/write_file.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kSchema = 1;
constexpr int64_t kNanoseconds = 1'000'000'000;
constexpr std::string_view kNext = ".next";  // the list of what comes, until it has come

Error refused(std::string message) {
  return {ErrorCode::illegal_parameter, std::move(message)};
}

Error failed(const std::string& what, const std::string& path) {
  return {ErrorCode::io, text("cannot ", what, " ", path, ": ", std::generic_category().message(errno))};
}

int64_t time_of(const struct stat& file) {
  return int64_t{file.st_mtim.tv_sec} * kNanoseconds + file.st_mtim.tv_nsec;
}

bool is_there(const std::string& path, struct stat& file) {
  return lstat(path.c_str(), &file) == 0;
}

// A name that leads nowhere else.
bool is_plain(const std::string& name) {
  return !name.empty() && name.find('/') == name.npos && name != "." && name != "..";
}

// JSON has no other bytes than UTF-8; names of files do. Bytes that are not are kept as numbers.
Json json_of(const std::string& name) {
  const Json json = name;
  try {
    [[maybe_unused]] const std::string checked = json.dump();
    return json;
  } catch (const Json::exception&) {
    return std::vector<uint8_t>(name.begin(), name.end());
  }
}

std::string name_of(const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  const auto bytes = json.get<std::vector<uint8_t>>();
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string list_name_of(std::string_view name) {
  return text('.', name, kListName);
}

bool is_list_name(std::string_view name) {
  if (name.ends_with(kNext)) name.remove_suffix(kNext.size());
  return name.starts_with('.') && name.ends_with(kListName);
}

std::string OwnedFiles::path_of(const std::string& file) const {
  return (fs::path(folder_) / file).string();
}

Result<OwnedFiles> OwnedFiles::read(const std::string& folder, const std::string& list_name) {
  OwnedFiles owned(folder);
  for (const std::string& name : {list_name, text(list_name, kNext)}) {
    if (auto r = owned.read_list(name); !r) return r.error();
  }
  return owned;
}

Result<void> OwnedFiles::read_list(const std::string& name) {
  const std::string path = path_of(name);
  struct stat status {};
  if (!is_there(path, status)) return {};
  const auto foreign = [&] { return refused(text(path, " is no list of scarf; move it away")); };
  if (!S_ISREG(status.st_mode)) return foreign();
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) return Error{ErrorCode::io, text("cannot read ", path)};
  try {
    const Json json = Json::parse(content);
    if (json.at("schema") != kSchema) return foreign();
    for (const Json& entry : json.at("files")) {
      File one{std::nullopt, time_of(status)};
      if (entry.contains("bytes")) one.bytes = entry.at("bytes").get<uint64_t>();
      const std::string called = name_of(entry.at("name"));
      if (!is_plain(called)) return foreign();
      files_.emplace(called, one);
    }
  } catch (const Json::exception&) {
    return foreign();
  }
  return {};
}

bool OwnedFiles::owns(const std::string& file) const {
  struct stat status {};
  if (!is_there(path_of(file), status)) return false;
  const auto [begin, end] = files_.equal_range(file);
  return std::any_of(begin, end, [&](const auto& named) {
    const File& f = named.second;
    if (f.bytes) {
      return S_ISREG(status.st_mode) && static_cast<uint64_t>(status.st_size) == *f.bytes &&
             time_of(status) == f.written;
    }
    if (!S_ISDIR(status.st_mode)) return false;
    const auto inner = read(path_of(file));
    if (!inner) return false;
    std::error_code error;
    for (fs::directory_iterator entry(path_of(file), error), last; !error && entry != last;
         entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (!is_list_name(name) && !inner->owns(name)) return false;
    }
    return !error;
  });
}

Result<void> OwnedFiles::check(const std::vector<std::string>& files, bool replace,
                               const OutputRule& rule) const {
  std::set<std::string> all(files.begin(), files.end());
  for (const auto& [name, file] : files_) all.insert(name);
  for (const std::string& file : all) {
    const std::string path = path_of(file);
    struct stat status {};
    if (!is_there(path, status)) continue;
    if (const auto input = rule.input_of(status)) {
      return refused(text(path, " is ", *input == path ? "an input" : text("the input ", *input),
                          ", which is never written to; give another output"));
    }
    if (!owns(file)) {
      return refused(
          names(file) ? text(path, " was changed after scarf wrote it; move it away, or give another output")
                      : text(path, " was not written by scarf; move it away, or give another output"));
    }
    if (!replace) {
      return refused(text(
          path,
          " is there from an earlier run; replace it with WriteOptions::overwrite, or give another output"));
    }
  }
  return {};
}

Result<void> OwnedFiles::remove(const std::string& file) const {
  const std::string path = path_of(file);
  struct stat status {};
  if (!is_there(path, status)) return {};
  if (!S_ISDIR(status.st_mode)) return remove_file(path);
  const auto inner = read(path);
  if (!inner) return inner.error();
  for (const auto& [name, one] : inner->files_) {
    if (!inner->owns(name)) continue;
    if (auto r = remove_file(inner->path_of(name)); !r) return r;
  }
  for (const std::string& list : {std::string(kListName), text(kListName, kNext)}) {
    if (auto r = remove_file(inner->path_of(list)); !r) return r;
  }
  return remove_empty_folder(path);
}

Result<void> OwnedFiles::list(const ScratchFolder& scratch, const std::vector<std::string>& files,
                              const std::string& list_name) {
  Json entries = Json::array();
  for (const std::string& file : files) {
    struct stat status {};
    if (!is_there(scratch.file(file), status)) return failed("find", scratch.file(file));
    Json entry = {{"name", json_of(file)}};
    if (!S_ISDIR(status.st_mode)) entry["bytes"] = status.st_size;
    entries.push_back(entry);
  }
  const Json json = {{"schema", kSchema}, {"files", entries}};
  if (auto r = write_file(scratch.file(list_name), json.dump(0) + "\n", OutputRule()); !r) return r;
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const std::array<timespec, 2> times{now, now};
  std::vector<std::string> all = files;
  all.push_back(list_name);
  for (const std::string& file : all) {
    if (utimensat(AT_FDCWD, scratch.file(file).c_str(), times.data(), AT_SYMLINK_NOFOLLOW) != 0)
      return failed("write", scratch.file(file));
  }
  return sync_tree(scratch.path());
}

Result<void> OwnedFiles::replace(const std::string& folder, const std::string& list_name,
                                 ScratchFolder& scratch, const std::vector<std::string>& files, bool replace,
                                 const OutputRule& rule) {
  const auto before = read(folder, list_name);
  if (!before) return before.error();
  if (auto r = before->check(files, replace, rule); !r) return r;
  if (auto r = list(scratch, files, list_name); !r) return r;

  const std::string& last = files.back();
  if (before->owns(last)) {
    if (auto r = before->remove(last); !r) return r;
  }
  if (auto r = sync_folder(folder); !r) return r;
  std::set<std::string> old;
  for (const auto& [name, file] : before->files_) old.insert(name);
  for (const std::string& name : old) {
    if (!before->owns(name)) continue;
    if (auto r = before->remove(name); !r) return r;
  }
  // The list of what comes is there before it comes; that of what was there still is.
  const std::string next = before->path_of(text(list_name, kNext));
  if (auto r = rename_over(scratch.file(list_name), next); !r) return r;
  for (const std::string& file : files) {
    if (file == last) {
      if (auto r = sync_folder(folder); !r) return r;
    }
    if (auto r = rename_to_free_name(scratch.file(file), before->path_of(file)); !r) return r;
  }
  if (auto r = rename_over(next, before->path_of(list_name)); !r) return r;
  return sync_folder(folder);
}

}  // namespace scarf
