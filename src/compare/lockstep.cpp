#include "compare/lockstep.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/format.h"
#include "session/progress.h"

namespace scarf {
namespace {

std::string shown(const Result<PushReport>& report) {
  if (!report) return text("'", report.error().message, "'");
  return text(report->accepted, " accepted and ", report->outside, " outside");
}

bool equal(const Result<PushReport>& a, const Result<PushReport>& b) {
  if (!a || !b) return !a && !b;
  return a->accepted == b->accepted && a->outside == b->outside;
}

}  // namespace

Result<Lockstep> run_in_lockstep(EventSource& source, const PlayOptions& options, Representation& a,
                                 Representation& b, const SideNames& names, Tolerance* tolerance) {
  Lockstep run;
  Progress progress(source);
  const auto push_and_compare = [&](std::span<const Event> events) -> Result<void> {
    const auto report_a = a.push(events);
    const auto report_b = b.push(events);
    run.events += events.size();
    run.batches += 1;
    progress.add(events.size());
    if (!equal(report_a, report_b)) {
      run.difference =
          text("push: ", shown(report_a), " in ", names.a, ", ", shown(report_b), " in ", names.b);
    } else if (!report_a) {
      return report_a.error();
    } else {
      auto difference = first_difference(a, b, names, tolerance);
      if (!difference) return difference.error();
      run.difference = *std::move(difference);
    }
    // Ends the play; told from a true error by the difference.
    if (run.difference) return Error{ErrorCode::bad_input, *run.difference};
    run.agreed = run.events;
    return {};
  };
  const auto played = play(source, options, {.events = push_and_compare});
  if (!played && !run.difference) return played.error();
  return run;
}

Lockstep shortest_failure(Lockstep failed, const OpenAgain& open_again, const PlayOptions& options,
                          Representation& a, Representation& b, const SideNames& names,
                          const std::function<std::unique_ptr<Tolerance>()>& make_tolerance) {
  uint64_t good = failed.agreed;
  while (good + 1 < failed.events) {
    PlayOptions shorter = options;
    shorter.max_events = good + (failed.events - good) / 2;
    const auto source = open_again();
    if (!source || !a.reset() || !b.reset()) break;
    const auto tolerance = make_tolerance ? make_tolerance() : nullptr;
    auto run = run_in_lockstep(**source, shorter, a, b, names, tolerance.get());
    if (!run) break;
    if (run->difference) {
      failed = *std::move(run);
      good = std::min(good, failed.agreed);  // a failure that comes and goes may come earlier
    } else {
      good = shorter.max_events;
    }
  }
  return failed;
}

Result<void> write_prefix(const OpenAgain& open_again, SensorSize sensor, uint64_t events,
                          const std::string& path, const OutputRule& rule) {
  const auto source = open_again();
  if (!source) return source.error();
  const auto sink = create_recording(path, "text", sensor, rule);
  if (!sink) return sink.error();
  const auto write = [&](std::span<const Event> batch) { return (*sink)->write(batch); };
  const auto played = play(**source, {.max_events = events}, {.events = write});
  if (!played) return played.error();
  return (*sink)->finish();
}

}  // namespace scarf
