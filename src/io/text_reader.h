// Reader of text lines `t x y p`, t in seconds.
// Source: the layout of the Event-Camera Dataset, and of E2VID with its first line `width height`.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/byte_reader.h"
#include "scarf/io.h"

namespace scarf {

/// What the beginning of a text recording says.
struct TextStart {
  std::optional<SensorSize> size;  ///< of the first line, if it is `width height`; as it stands, unchecked
  size_t bytes = 0;                ///< up to and with that line; 0 without it
};

/// The start of a text recording, or nullopt if no line of `bytes` is one. `last`: nothing follows `bytes`.
std::optional<TextStart> find_text_start(std::span<const uint8_t> bytes, bool last);

/// A source of the lines that `input` stands at, behind the line `width height`.
std::unique_ptr<EventSource> make_text_reader(ByteReader input, std::string name,
                                              std::optional<SensorSize> sensor);

}  // namespace scarf
