// What the numbers of columns that nobody has named look like, and which order of columns they allow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/base/columns.h"

namespace scarf {

/// One column of the first rows.
class ColumnLook {
 public:
  void add(double number);
  /// What is no number, such as a date.
  void add_other() { ++rows_; }

  /// Numbers that a polarity column may hold, in at least nine of ten rows; and whole numbers.
  bool is_polarity() const { return most(polarities_); }
  bool is_whole() const { return most(whole_); }
  /// Whole numbers within the largest sensor.
  bool is_coordinate() const { return most(coordinates_); }
  /// Numbers, nine of ten of which are not smaller than the one before them.
  bool rises() const { return most(numbers_) && falls_ * 10 <= rows_; }
  /// Some numbers differ.
  bool moves() const { return moves_; }
  bool has_numbers() const { return numbers_ > 0; }
  bool has_fractions() const { return whole_ < numbers_; }
  bool is_zero() const { return numbers_ == rows_ && !moves_ && previous_ == 0; }

 private:
  bool most(size_t count) const { return rows_ > 0 && count * 10 >= rows_ * 9; }

  size_t rows_ = 0;
  size_t numbers_ = 0;
  size_t whole_ = 0;
  size_t coordinates_ = 0;
  size_t polarities_ = 0;
  size_t falls_ = 0;
  bool moves_ = false;
  double previous_ = 0;
};

/// Whether the columns, as many as `looks`, may have this order: polarities where it says p, and whole
/// numbers where it says x and y.
bool allows(std::span<const ColumnLook> looks, const std::vector<Column>& order);

/// Whether the times rise in this order. Those with fractions may fall, if no other column rises.
bool has_times(std::span<const ColumnLook> looks, const std::vector<Column>& order);

/// An order that the rows allow, as ReadOptions::columns; empty if there is none. More than six columns that
/// nobody has named are not taken for events: tables of boxes, poses and inertial units have as many.
std::string likely_order(std::span<const ColumnLook> looks);

}  // namespace scarf
