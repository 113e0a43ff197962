// The beginning of a text recording: sizes, names of columns, and how its lines look.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/base/column_look.h"
#include "io/text/text_lines.h"
#include "scarf/core/event.h"
#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf {

struct TextStart {
  size_t bytes = 0;                ///< of the lines that hold no events
  std::optional<SensorSize> size;  ///< of a line `width height` or `%geometry:width,height`; unchecked
  bool percent = false;            ///< there are lines that begin with %, as OpenEB writes them
  std::vector<ColumnName> names;   ///< of a line that names t, x, y and p; empty without one
  bool named_on = false;           ///< the polarity's name is `on`, as faery writes it
  std::string heading;             ///< a line without any number that names them not, as it stands
  bool heading_of_events = false;  ///< it names a polarity and coordinates nevertheless

  // Of the lines behind, as far as they were seen; 0 fields: there was none.
  size_t fields = 0;  ///< of the first one ...
  bool open = false;  ///< ... which ends in a separator: the last field may be none
  Separator separator = Separator::blanks;
  std::vector<ColumnLook> looks;  ///< of its columns; without the last one, if the line is open
  uint32_t decimals = 0;          ///< bit per column: some number is written with decimals or an exponent
  std::string date;               ///< what looks like one, in a column that may be that of the times
};

/// nullopt if no line of `bytes` can be an event. `last`: nothing follows `bytes`.
std::optional<TextStart> find_text_start(std::span<const uint8_t> bytes, bool last);

/// Whether nobody but the lines themselves says the order of their columns.
bool is_order_guessed(const TextStart& start, const ReadOptions& options);

/// What the start, the options and the lines of `bytes` say of the lines; more bytes may say more. `csv`: as
/// OpenEB writes them, where nobody says. Errors: bad_input, naming the option that has to say, also if no
/// line is what the layout would say; unrecognised, if the lines look like no events in any order;
/// illegal_parameter.
Result<TextLayout> text_layout(const TextStart& start, std::span<const uint8_t> bytes, bool csv,
                               const ReadOptions& options);

}  // namespace scarf
