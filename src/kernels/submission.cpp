#include "kernels/submission.h"

#include "core/text.h"
#include "shaders/common/layout.h"

namespace scarf {
namespace {

constexpr uint32_t kMaxStagingSlots = 16;
constexpr uint32_t kMaxBands = 64;
constexpr uint32_t kMaxSubmissionEvents = 1u << 24;
constexpr uint32_t kSubmissionEventsCpu = 1u << 18;
constexpr uint32_t kSubmissionEventsGpu = 1u << 20;

Error illegal(const char* name, uint32_t value, uint32_t least, uint32_t most) {
  return {ErrorCode::illegal_parameter, text(name, " is ", value, ", legal is ", least, " to ", most)};
}

}  // namespace

Result<void> check_options(const GpuOptions& o) {
  if (o.staging_slots < 1 || o.staging_slots > kMaxStagingSlots)
    return illegal("staging_slots", o.staging_slots, 1, kMaxStagingSlots);
  if (o.submission_events > kMaxSubmissionEvents)
    return illegal("submission_events", o.submission_events, 0, kMaxSubmissionEvents);
  if (o.chunk_events > layout::kMaxChunkEvents)
    return illegal("chunk_events", o.chunk_events, 0, layout::kMaxChunkEvents);
  if (o.bands > kMaxBands) return illegal("bands", o.bands, 0, kMaxBands);
  return {};
}

uint32_t submission_events(const GpuOptions& options, const vulkan::Limits& limits) {
  if (options.submission_events != 0) return options.submission_events;
  return limits.cpu ? kSubmissionEventsCpu : kSubmissionEventsGpu;
}

}  // namespace scarf
