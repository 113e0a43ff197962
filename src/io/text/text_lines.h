// Lines of text recordings: columns of numbers, one event per line.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/columns.h"
#include "scarf/core/event.h"

namespace scarf {

/// Longer lines are skipped unread.
inline constexpr size_t kMaxLine = 4096;
inline constexpr size_t kMaxFields = 32;

/// What parts the fields of a line: a mark each, between which a field may be empty, or blanks, spaces and
/// tabs, as many as there are.
enum class Separator : char { blanks = ' ', tab = '\t', comma = ',', semicolon = ';' };

/// That of a line: a semicolon, else a comma, else, if it has no space, a tab; marks in quotes do not count.
Separator separator_of(std::string_view line);

/// The fields of a line, without blanks around them and without their quotes.
struct Fields {
  std::array<std::string_view, kMaxFields> text;
  size_t count = 0;  ///< may be kMaxFields + 1: too many

  /// How many there are if the line ends in a separator, behind which is nothing.
  size_t without_last_empty() const;
};

Fields split(std::string_view line, Separator separator);

/// Whether the line holds nothing, or is a comment, which begins with #.
bool is_blank_or_comment(std::string_view line);

/// What a field of a column of polarities may be.
enum class PolarityField {
  off,        ///< 0, -1, false, off; as decimal numbers, too, and in any case of letters
  on,         ///< 1, true, on
  undefined,  ///< another number
  none,       ///< no number
};
PolarityField polarity_field(std::string_view field);

/// Where a line has what.
class TextLayout {
 public:
  /// `columns` are complete; times are units of 10^exponent microseconds; `camera` is the one whose lines
  /// count, if there is a column of cameras.
  TextLayout(const std::vector<Column>& columns, Separator separator, int exponent, std::string camera = {});

  struct Line {
    /// undefined: an event whose polarity is a number that stands for none.
    enum Kind { blank, event, outside, undefined, unknown } kind = unknown;
    Event content;  ///< of an event; of one outside, t alone
  };
  Line parse(std::string_view line) const;

 private:
  size_t count_;
  size_t t_;
  size_t x_;
  size_t y_;
  size_t p_;
  std::optional<size_t> camera_column_;
  Separator separator_;
  int exponent_;
  std::string camera_;
};

}  // namespace scarf
