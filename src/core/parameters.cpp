// Every parameter of every representation, said once.
#include "scarf/core/parameters.h"

#include <cmath>

#include "core/fields.h"

namespace scarf {
namespace {

Field positive(const char* name, auto& value, const char* description) {
  const double number = std::optional<double>(value).value_or(1);
  return field(name, value, std::isfinite(number) && number > 0, "a finite number > 0", description);
}

Field kernel(int32_t& value) {
  return field("kernel", value, 2 <= value && value <= 63, "odd, 3 to 63 (an even number is raised by 1)",
               "pixels of an event's window, per axis");
}
constexpr int32_t odd_kernel(int32_t kernel) {
  return kernel % 2 == 0 ? kernel + 1 : kernel;
}

}  // namespace

template <class Visit>
void fields(ScarfParameters& p, Visit visit) {
  // A SCARF of thirteen integers is made from a Geometry, not from Parameters.
  visit(choice("preset", p.preset, {"paper", "light", "event_driven", "event_driven_flex"},
               "how the patches lie"));
  const int32_t cell = p.grid.cell.value_or(1);
  visit(field("cell", p.grid.cell, 1 <= cell && cell <= kMaxField, "1 to 128",
              "pixels of a patch's active region"));
  const double ratio = p.grid.ratio.value_or(0);
  visit(field(
      "ratio", p.grid.ratio, std::isfinite(ratio) && ratio >= 0, "a finite number >= 0",
      "reach of a receptive field beyond its cell, in cells; presets paper and event_driven_flex only"));
  visit(positive("alpha", p.grid.alpha, "scale of the number of events that a patch keeps"));
  visit(positive("accumulation", p.accumulation, "brightness of one event"));
}

template <class Visit>
void fields(TimeWindowParameters& p, Visit visit) {
  visit(between("window", p.window, 1, 100'000'000, "length of the window"));
  visit(choice("counts", p.counts, "show how often pixels fired, instead of whether"));
  visit(positive("accumulation", p.accumulation, "brightness of one event, with counts"));
}

template <class Visit>
void fields(SaeParameters& p, Visit visit) {
  visit(choice("decay", p.decay, {"exponential", "linear"}, "how brightness falls with age"));
  visit(between("tau", p.tau, 1, 10'000'000, "time constant, or length of the linear ramp"));
}

template <class Visit>
void fields(ErosParameters& p, Visit visit) {
  visit(kernel(p.kernel));
  visit(field("decay", p.decay, p.decay > 0 && p.decay < 1, "a number > 0 and < 1",
              "an event scales its window by decay^(1/kernel)"));
}

template <class Visit>
void fields(TosParameters& p, Visit visit) {
  visit(kernel(p.kernel));
  const double range = odd_kernel(p.kernel) * p.decay;
  visit(field("decay", p.decay, range > 0 && range < 255, "a number > 0 and < 255 / kernel",
              "levels below 255 - kernel * decay become 0"));
}

template <class Visit>
void fields(SitsParameters& p, Visit visit) {
  visit(choice("rule", p.rule, {"paper", "greater", "event_driven"},
               "which pixels of the window an event weakens"));
  visit(kernel(p.kernel));
}

template <class Visit>
void fields(ChainSaeParameters& p, Visit visit) {
  visit(choice("rule", p.rule, {"paper", "event_driven"}, "which pixels have a rank"));
  visit(choice("linear", p.linear, "brightness linear in the rank, instead of its 10th power"));
}

template <class Visit>
void fields(AedSaeParameters& p, Visit visit) {
  visit(between("window", p.window, 1'000, 100'000'000, "how long events count for the density"));
  visit(positive("lambda", p.lambda, "scale of the decay"));
}

template <class Visit>
void fields(AaeParameters& p, Visit visit) {
  visit(between("block", p.block, 1, 1024, "pixels of a block, per axis; not with esvo2"));
  visit(choice("keep", p.keep, "a query leaves the queues as they are"));
  visit(choice("esvo2", p.esvo2, "8 x 6 blocks, events since the last query"));
}

namespace {

std::vector<RepresentationInfo> make_infos() {
  std::vector<RepresentationInfo> infos = {
      {"scarf", "SCARF", "the last events of overlapping patches, independent of their speed",
       describe_fields(ScarfParameters{.grid = {.cell = 9, .ratio = 1.2, .alpha = 2.0}})},
      {"time_window", "time window", "the pixels that fired within a window of time",
       describe_fields<TimeWindowParameters>()},
      {"sae", "SAE (time surface)", "the time since each pixel last fired", describe_fields<SaeParameters>()},
      {"eros", "EROS", "each event makes its pixel white and scales its window",
       describe_fields<ErosParameters>()},
      {"tos", "TOS", "each event makes its pixel white and lowers its window, with a threshold",
       describe_fields<TosParameters>()},
      {"sits", "SITS", "each event lowers the newer pixels of its window", describe_fields<SitsParameters>()},
      {"chain_sae", "CHAIN-SAE", "the pixels by the order in which they last fired",
       describe_fields<ChainSaeParameters>()},
      {"aed_sae", "AED-SAE", "a time surface whose decay follows from the density of the events",
       describe_fields<AedSaeParameters>()},
      {"aae", "AAE", "as many of each block's newest events as its activity asks for",
       describe_fields<AaeParameters>()},
  };
  for (RepresentationInfo& info : infos) {
    info.exact = info.name != "aed_sae" && info.name != "aae";
    info.has_events = info.name == "scarf" || info.name == "time_window" || info.name == "aae";
  }
  return infos;
}

}  // namespace

std::span<const RepresentationInfo> representations() {
  static const std::vector<RepresentationInfo> infos = make_infos();
  return infos;
}

const RepresentationInfo& info_of(const Parameters& parameters) {
  return representations()[parameters.index()];
}

bool query_changes_state(const Parameters& parameters) {
  if (const auto* aae = std::get_if<AaeParameters>(&parameters)) return !aae->keep;
  const auto* chain = std::get_if<ChainSaeParameters>(&parameters);
  return chain != nullptr && chain->rule == ChainSaeParameters::Rule::event_driven;
}

Result<Parameters> parse_parameters(const std::string& representation,
                                    const std::map<std::string, std::string>& words) {
  return as_result([&]() -> Result<Parameters> {
    const auto parameters =
        read_alternative<Parameters>("representation", representations(), {representation, words});
    return parameters ? checked_parameters(*parameters) : parameters;
  });
}

Result<Parameters> checked_parameters(Parameters parameters) {
  return as_result([&]() -> Result<Parameters> {
    const auto raise = [](auto& p) {
      if constexpr (requires { p.kernel; }) p.kernel = odd_kernel(p.kernel);
    };
    auto checked = checked_alternative(parameters);
    if (checked) std::visit(raise, *checked);
    return checked;
  });
}

}  // namespace scarf
