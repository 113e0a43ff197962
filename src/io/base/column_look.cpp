#include "io/base/column_look.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scarf/core/patch_grid.h"

namespace scarf {
namespace {

constexpr size_t kMostColumns = 6;

}  // namespace

void ColumnLook::add(double number) {
  ++rows_;
  if (!std::isfinite(number)) return;
  const bool whole = number == std::floor(number);
  whole_ += whole ? 1 : 0;
  coordinates_ += whole && number >= 0 && number < kMaxSensorSize ? 1 : 0;
  polarities_ += number == 0 || number == 1 || number == -1 ? 1 : 0;
  if (numbers_ > 0) {
    falls_ += number < previous_ ? 1 : 0;
    moves_ |= number != previous_;
  }
  ++numbers_;
  previous_ = number;
}

bool allows(std::span<const ColumnLook> looks, const std::vector<Column>& order) {
  if (looks.size() != order.size()) return false;
  for (size_t i = 0; i < looks.size(); ++i) {
    if (order[i] == Column::p && !looks[i].is_polarity()) return false;
    if ((order[i] == Column::x || order[i] == Column::y) && !looks[i].is_whole()) return false;
  }
  return true;
}

bool has_times(std::span<const ColumnLook> looks, const std::vector<Column>& order) {
  bool whole_times = false;
  bool another_rises = false;
  for (size_t i = 0; i < std::min(looks.size(), order.size()); ++i) {
    const ColumnLook& look = looks[i];
    if (order[i] == Column::t) {
      if (look.rises()) return true;
      whole_times = !look.has_fractions();
    }
    if (order[i] == Column::x || order[i] == Column::y) another_rises |= look.rises() && look.moves();
  }
  return !whole_times && !another_rises;
}

std::string likely_order(std::span<const ColumnLook> looks) {
  if (looks.size() < 4 || looks.size() > kMostColumns) return {};
  std::optional<size_t> t;
  std::optional<size_t> p;
  for (size_t i = 0; i < looks.size(); ++i) {
    if (looks[i].is_polarity()) {
      if (!p || looks[i].moves() || !looks[*p].moves()) p = i;
    } else if (looks[i].rises() && looks[i].moves()) {
      // Coordinates may rise, too.
      if (!t || (looks[*t].is_coordinate() && !looks[i].is_coordinate())) t = i;
    }
  }
  if (!t || !p || (looks.size() > 4 && !looks[*p].moves())) return {};
  std::string order(looks.size(), '_');
  order[*t] = 't';
  order[*p] = 'p';
  char next = 'x';
  for (size_t i = 0; i < looks.size() && next <= 'y'; ++i) {
    if (order[i] == '_' && looks[i].is_coordinate()) order[i] = next++;
  }
  return next > 'y' ? order : std::string();
}

}  // namespace scarf
