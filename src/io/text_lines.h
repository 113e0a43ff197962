// Lines of text recordings: columns of numbers, one event per line.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"
#include "scarf/event.h"

namespace scarf {

/// Longer lines are skipped unread.
inline constexpr size_t kMaxLine = 4096;
inline constexpr size_t kMaxFields = 32;

/// The fields of a line, separated by spaces, tabs or commas.
struct Fields {
  std::array<std::string_view, kMaxFields> text;
  size_t count = 0;  ///< may be kMaxFields + 1: too many
};

Fields split(std::string_view line);

/// Whether the line is empty or a comment.
bool is_blank(std::string_view line);

/// Whether the token is one that a polarity column may hold.
bool is_polarity(std::string_view token);

/// Where a line has what.
class TextLayout {
 public:
  /// `columns` are complete; times are units of 10^exponent microseconds; `camera` is the one whose lines
  /// count, if there is a column of cameras.
  TextLayout(const std::vector<Column>& columns, int exponent, std::string camera = {});

  struct Line {
    enum Kind { blank, event, outside, unknown } kind = unknown;
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
  int exponent_;
  std::string camera_;
};

}  // namespace scarf
