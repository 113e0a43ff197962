// Which word format bytes without a header are in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "io/evt/evt21.h"

namespace scarf {

/// Whether bytes look like words of the format; each is beside its reader.
bool looks_like_evt2(std::span<const uint8_t> bytes);
bool looks_like_evt3(std::span<const uint8_t> bytes);
bool looks_like_evt4(std::span<const uint8_t> bytes);
/// The byte order in which they look like EVT2.1; nullopt if in none or in both.
std::optional<evt21::ByteOrder> looks_like_evt21(std::span<const uint8_t> bytes);
/// Whether TIME_HIGH words of EVT2 lie at even and odd places alike, as they do not in EVT2.1.
bool time_highs_at_every_place(std::span<const uint8_t> bytes);

/// The name of the one format that the bytes look like; empty if there is none, or more than one.
std::string_view guess_words(std::span<const uint8_t> bytes);

}  // namespace scarf
