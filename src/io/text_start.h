// The beginning of a text recording: sizes, names of columns, and how its lines look.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_lines.h"
#include "scarf/event.h"
#include "scarf/io.h"
#include "scarf/result.h"

namespace scarf {

struct TextStart {
  size_t bytes = 0;                ///< of the lines that hold no events
  std::optional<SensorSize> size;  ///< of a line `width height` or `%geometry:width,height`; unchecked
  bool percent = false;            ///< there are lines that begin with %, as OpenEB writes them
  std::vector<Column> names;       ///< of a line with names; empty without one
  bool named_on = false;           ///< the polarity's name is `on`, as faery writes it

  // Of the lines behind, as far as they were seen; 0 columns: there was none.
  size_t columns = 0;
  bool plain = false;       ///< a line reads as `t x y p`
  uint32_t fractional = 0;  ///< bit per column: some number of it has a fraction or an exponent
};

/// nullopt if no line of `bytes` can be an event. `last`: nothing follows `bytes`.
std::optional<TextStart> find_text_start(std::span<const uint8_t> bytes, bool last);

/// What the start and the options say of the lines. `csv`: as OpenEB writes them, where nobody says. Errors:
/// bad_input, naming the option that has to say; illegal_parameter.
Result<TextLayout> text_layout(const TextStart& start, bool csv, const ReadOptions& options);

/// Whether more lines could tell the unit of the times.
bool wants_more_lines(const TextStart& start, bool csv, const ReadOptions& options);

}  // namespace scarf
