// The paper's costs of a representation: time per event (C/E), time per query (C/U), and the events per
// second that are left at different rates of queries.
#pragma once

#include <array>
#include <optional>

#include "bench/endless.h"
#include "scarf/core/parameters.h"
#include "scarf/core/representation.h"

namespace scarf::bench {

inline constexpr std::array<int32_t, 4> kQueryRates = {30, 100, 300, 1000};  ///< per second of recorded time
inline constexpr size_t kBatch = 10'000;                                     ///< events per push

struct Costs {
  double ns_per_event = 0;  ///< pushes alone, until the device has done its work on them
  double query_us = 0;      ///< median; one u8 image in host memory, of a state whose pushes are done
  /// Events per second of real time with queries at each of kQueryRates; none where the events between two
  /// queries would have taken too long.
  std::array<std::optional<double>, kQueryRates.size()> events_per_second;
};

/// Measures for about `seconds` each of the costs, for longer where the work cannot be divided.
/// `parameters` are those of the representation; the stream is made for the slowest of kQueryRates.
Result<Costs> measure_costs(Representation& representation, const Parameters& parameters,
                            EndlessStream& stream, double seconds);

}  // namespace scarf::bench
