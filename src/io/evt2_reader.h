// Reader of EVT2 words.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/byte_reader.h"
#include "scarf/io.h"

namespace scarf {

/// A source of the words that `input` stands at.
std::unique_ptr<EventSource> make_evt2_reader(ByteReader input, std::string name,
                                              std::optional<SensorSize> sensor);

/// Whether bytes that no header announces look like EVT2.
bool looks_like_evt2(std::span<const uint8_t> bytes);

}  // namespace scarf
