#include "vulkan/pipeline_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "core/little_endian.h"
#include "core/regular_file.h"

namespace scarf::vulkan {
namespace {

constexpr std::string_view kMagic = "SCARFPC1";
constexpr size_t kHeaderBytes = kMagic.size() + 2 * sizeof(uint64_t);  // number of bytes, checksum

// FNV-1a: against disks and interrupted writes. Against people there is the file's owner.
uint64_t checksum_of(std::span<const uint8_t> bytes) {
  uint64_t sum = 0xCBF29CE484222325;
  for (const uint8_t byte : bytes) sum = (sum ^ byte) * 0x100000001B3;
  return sum;
}

bool is_ours(int fd) {
  struct stat status {};
  if (fstat(fd, &status) != 0) return false;
  const bool owner = status.st_uid == geteuid() || status.st_uid == 0;
  return owner && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

bool write_all(int fd, std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(count));
  }
  return true;
}

}  // namespace

std::vector<uint8_t> sealed_pipelines(std::span<const uint8_t> pipelines) {
  std::vector<uint8_t> content(kMagic.begin(), kMagic.end());
  content.reserve(kHeaderBytes + pipelines.size());
  append_little_endian(content, uint64_t{pipelines.size()});
  append_little_endian(content, checksum_of(pipelines));
  content.insert(content.end(), pipelines.begin(), pipelines.end());
  return content;
}

std::optional<std::span<const uint8_t>> unsealed_pipelines(std::span<const uint8_t> content) {
  if (content.size() < kHeaderBytes || !std::equal(kMagic.begin(), kMagic.end(), content.begin())) {
    return std::nullopt;
  }
  const auto bytes = load_little_endian<uint64_t>(&content[kMagic.size()]);
  const auto checksum = load_little_endian<uint64_t>(&content[kMagic.size() + sizeof(uint64_t)]);
  const auto pipelines = content.subspan(kHeaderBytes);
  if (pipelines.size() != bytes || checksum_of(pipelines) != checksum) return std::nullopt;
  return pipelines;
}

std::vector<uint8_t> load_pipelines(const std::string& path) noexcept {
  try {
    const auto file = open_regular(path);
    if (!file || !is_ours(file->get())) return {};
    const auto content = read_whole(*file, kHeaderBytes + kMaxPipelineCache);
    if (!content) return {};
    const auto pipelines =
        unsealed_pipelines({reinterpret_cast<const uint8_t*>(content->data()), content->size()});
    return pipelines ? std::vector<uint8_t>(pipelines->begin(), pipelines->end()) : std::vector<uint8_t>();
  } catch (const std::exception&) {  // no memory
    return {};
  }
}

void save_pipelines(const std::string& path, std::span<const uint8_t> pipelines) noexcept {
  try {
    if (pipelines.size() > kMaxPipelineCache) return;
    const std::vector<uint8_t> content = sealed_pipelines(pipelines);
    std::error_code ignored;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
    // Renamed into place, so that no other process reads half of it, and only once it is on the disk.
    std::string temporary = path + ".XXXXXX";
    const FileDescriptor file(mkostemp(temporary.data(), O_CLOEXEC));
    if (file.get() < 0) return;
    const bool written = write_all(file.get(), content) && fsync(file.get()) == 0;
    if (!written || std::rename(temporary.c_str(), path.c_str()) != 0) unlink(temporary.c_str());
  } catch (const std::exception&) {  // no memory: a cache that is not written only costs time
  }
}

}  // namespace scarf::vulkan
