// Text recordings out of any container.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "io/base/format.h"

namespace scarf {

/// Lines of text as a source that calls itself `format`; `sensor` is what the container says. Errors: as
/// open_events.
Result<std::unique_ptr<EventSource>> open_text_lines(std::string_view format, Input input,
                                                     std::optional<SensorSize> sensor,
                                                     const ReadOptions& options);

}  // namespace scarf
