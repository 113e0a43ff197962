// The file in which compiled pipelines are kept from one run to the next. The driver trusts what it is given,
// so nothing is that was not written here: whole, unchanged, and by this user. Whatever is wrong with the
// file is a cache without content: the pipelines are compiled again, and the file is replaced. Neither
// function throws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scarf::vulkan {

/// Caches of more bytes are neither read nor written.
inline constexpr size_t kMaxPipelineCache = size_t{256} << 20;

/// The file's content for a driver's bytes: they have a header of ours in front, with their number and
/// checksum.
std::vector<uint8_t> sealed_pipelines(std::span<const uint8_t> pipelines);
/// The driver's bytes in a file's content; nullopt if it is not what sealed_pipelines() made.
std::optional<std::span<const uint8_t>> unsealed_pipelines(std::span<const uint8_t> content);

/// The driver's bytes in a file; empty unless the file is regular, belongs to this user or to root, can be
/// written by nobody else, and is whole.
std::vector<uint8_t> load_pipelines(const std::string& path) noexcept;

/// Replaces the file, and makes the folder that it is in. It stays as it was if the new one cannot be written
/// whole.
void save_pipelines(const std::string& path, std::span<const uint8_t> pipelines) noexcept;

}  // namespace scarf::vulkan
