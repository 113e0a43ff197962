// Which word format bytes without a header are in.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace scarf {

// Whether bytes look like words of the format; each is beside its reader.
bool looks_like_evt2(std::span<const uint8_t> bytes);
bool looks_like_evt3(std::span<const uint8_t> bytes);

/// The name of the one format that the bytes look like; empty if there is none, or more than one.
std::string_view guess_words(std::span<const uint8_t> bytes);

}  // namespace scarf
