// The paper's cost table as text: rows for people, CSV, and the figure of throughput against query rate.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/paper.h"
#include "bench/plot.h"
#include "scarf/core/result.h"

namespace scarf::bench {

/// One representation on one sensor.
struct PaperRow {
  std::string representation;  ///< name, as "eros"
  std::string title;           ///< "EROS"
  SensorSize sensor;
  double stream_rate = 0;  ///< events per second of recorded time
  /// Or the reason why it could not be measured; empty if nobody asked for it.
  Result<Costs> reference = Error{};
  Result<Costs> device = Error{};
};

/// Why costs, or some of them, were not measured; empty if there is nothing to say.
std::string remark(const Result<Costs>& costs);

/// The heading of the table, and one line for a row. Remarks follow the row in lines of their own.
std::string table_head();
std::string table_line(const PaperRow& row);

/// One line for each row and implementation, below one that names the columns.
std::string csv(std::span<const PaperRow> rows);

/// One panel for each sensor and implementation.
Plot throughput_plot(std::span<const PaperRow> rows, const std::string& device_name);

}  // namespace scarf::bench
