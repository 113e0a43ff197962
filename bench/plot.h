// Line plots with logarithmic axes, as SVG.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scarf::bench {

struct Panel {
  std::string title;
  /// One for each of Plot::labels: (x, y), all positive, by rising x; empty where there is nothing to show.
  std::vector<std::vector<std::pair<double, double>>> lines;
  std::optional<double> level;  ///< a dashed horizontal line at this y
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::string level_label;          ///< what the dashed lines are
  std::vector<double> x_ticks;      ///< at least one; all x lie between the first and the last
  std::vector<std::string> labels;  ///< of the lines, for the legend
  std::vector<Panel> panels;        ///< side by side, `columns` to a row; all with the same axes
  size_t columns = 2;
};

/// The plot as an SVG document.
std::string svg(const Plot& plot);

}  // namespace scarf::bench
