// Columns of events that are found by their names, or named by ReadOptions::columns, wherever they lie in a
// file.
#pragma once

#include <string>

#include "io/hdf5/layouts.h"
#include "io/hdf5/library.h"
#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf::hdf5 {

/// The events that the options name, or else the only ones whose columns have names that scarf knows: data
/// sets of one group, or members of records. ReadOptions::stream chooses the group or data set. Groups are
/// looked at to a depth of 8, and 4,096 objects at most. Errors: unrecognised, if there are none; bad_input,
/// illegal_parameter, listing those that there are.
Result<EventPlaces> find_events(const Handle& file, const ReadOptions& options);

}  // namespace scarf::hdf5
