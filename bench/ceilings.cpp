#include "bench/ceilings.h"

#include <algorithm>
#include <functional>

#include "bench/push.h"
#include "compiled_shaders/shaders.h"
#include "kernels/pipeline_builder.h"
#include "shaders/common/layout.h"
#include "vulkan/commands.h"

namespace scarf::bench {
namespace {

using vulkan::Commands;

constexpr uint64_t kCopyBytes = uint64_t{64} << 20;
constexpr uint32_t kTableBits = 20;
constexpr uint32_t kAtomics = 1u << 22;
constexpr int kRuns = 5;

// The shortest time of a submission of what `record` records, in seconds.
Result<double> best_time(vulkan::Device& device, const std::function<void(Commands&)>& record) {
  auto commands = Commands::create(device, device.compute());
  if (!commands) return commands.error();
  double best = 1e9;
  for (int run = 0; run < kRuns + 1; ++run) {
    if (auto r = commands->begin(); !r) return r.error();
    record(*commands);
    const auto start = Clock::now();
    if (auto r = commands->submit(); !r) return r.error();
    if (auto r = commands->wait(); !r) return r.error();
    // The first run compiles and touches fresh memory.
    if (run > 0) best = std::min(best, seconds_since(start));
  }
  return best;
}

}  // namespace

Result<Ceilings> measure_ceilings(GpuContext& context) {
  vulkan::Device& device = context.vulkan();
  PipelineBuilder builder(device);
  vulkan::Buffer from, to, table, readback;
  builder.buffer(from, "the copy's source", kCopyBytes);
  builder.buffer(to, "the copy's target", kCopyBytes);
  builder.buffer(table, "the table of atomics", sizeof(uint32_t) << kTableBits);
  builder.readback(readback, "the copy for the host", kCopyBytes);
  vulkan::Kernel copy, atomic;
  builder.kernel(copy, "ceiling_copy", shaders::ceiling_copy, 2, sizeof(layout::CeilingPush));
  builder.kernel(atomic, "ceiling_atomic", shaders::ceiling_atomic, 1, sizeof(layout::CeilingPush));
  vulkan::BoundKernel bound_copy, bound_atomic;
  builder.bind(bound_copy, copy, {&from, &to});
  builder.bind(bound_atomic, atomic, {&table});
  if (!builder.result()) return builder.result().error();
  auto upload = vulkan::Buffer::create(device, "the host's copy", kCopyBytes, vulkan::MemoryUse::upload);
  if (!upload) return upload.error();

  Ceilings ceilings;
  const auto measure = [&](double& target, double amount, const std::function<void(Commands&)>& record) {
    const auto seconds = best_time(device, record);
    if (seconds) target = amount / *seconds;
    return seconds ? Result<void>() : Result<void>(seconds.error());
  };
  const auto bytes = static_cast<double>(kCopyBytes);
  double submissions_per_s = 0;
  const std::pair<double*, std::pair<double, std::function<void(Commands&)>>> runs[] = {
      {&submissions_per_s,
       {1,
        [&](Commands& c) {
          c.dispatch(bound_copy, 1, layout::kLinearGroup, layout::CeilingPush{0, 0});
        }}},
      {&ceilings.copy_bytes_per_s,
       {2 * bytes,
        [&](Commands& c) {
          constexpr uint32_t kInvocations = kCopyBytes / 16;
          c.dispatch(bound_copy, kInvocations, layout::kLinearGroup, layout::CeilingPush{kInvocations, 0});
        }}},
      {&ceilings.atomics_per_s,
       {kAtomics,
        [&](Commands& c) {
          c.dispatch(bound_atomic, kAtomics, layout::kLinearGroup, layout::CeilingPush{kAtomics, kTableBits});
        }}},
      {&ceilings.upload_bytes_per_s, {bytes, [&](Commands& c) { c.copy(*upload, 0, to, 0, kCopyBytes); }}},
      {&ceilings.readback_bytes_per_s,
       {bytes, [&](Commands& c) { c.copy(from, 0, readback, 0, kCopyBytes); }}},
  };
  for (const auto& [target, run] : runs) {
    if (auto r = measure(*target, run.first, run.second); !r) return r.error();
  }
  ceilings.submission_us = 1e6 / submissions_per_s;
  return ceilings;
}

}  // namespace scarf::bench
