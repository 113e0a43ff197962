// Every parameter of every representation, said once: fields() names them with their ranges, and visitors
// describe, read and check them.
#include "scarf/parameters.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "core/text.h"

namespace scarf {
namespace {

Error illegal(const std::string& what) {
  return {ErrorCode::illegal_parameter, what};
}

// The words of enumerations.
template <class E>
using Words = std::vector<std::pair<std::string_view, E>>;

// A SCARF of thirteen integers is made from a Geometry, not from Parameters.
const Words<Preset>& words_of(Preset) {
  static const Words<Preset> words = {{"paper", Preset::paper},
                                      {"light", Preset::light},
                                      {"event_driven", Preset::event_driven},
                                      {"event_driven_flex", Preset::event_driven_flex}};
  return words;
}
const Words<SaeParameters::Decay>& words_of(SaeParameters::Decay) {
  static const Words<SaeParameters::Decay> words = {{"exponential", SaeParameters::Decay::exponential},
                                                    {"linear", SaeParameters::Decay::linear}};
  return words;
}
const Words<SitsParameters::Rule>& words_of(SitsParameters::Rule) {
  static const Words<SitsParameters::Rule> words = {{"paper", SitsParameters::Rule::paper},
                                                    {"greater", SitsParameters::Rule::greater},
                                                    {"event_driven", SitsParameters::Rule::event_driven}};
  return words;
}
const Words<ChainSaeParameters::Rule>& words_of(ChainSaeParameters::Rule) {
  static const Words<ChainSaeParameters::Rule> words = {
      {"paper", ChainSaeParameters::Rule::paper}, {"event_driven", ChainSaeParameters::Rule::event_driven}};
  return words;
}

template <class E>
std::string choices() {
  std::string names;
  for (const auto& [name, value] : words_of(E{})) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

template <class E>
bool is_choice(E value) {
  for (const auto& [name, known] : words_of(E{})) {
    if (known == value) return true;
  }
  return false;
}

// Values from words; false: not readable. Every int64_t is a duration in microseconds.
template <class T>
bool read_number(std::string_view word, T& value, std::string_view& rest) {
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  rest = std::string_view(stop, static_cast<size_t>(end - stop));
  return error == std::errc();
}

template <class T>
requires std::is_same_v<T, int32_t> || std::is_same_v<T, double>
bool read(std::string_view word, T& value) {
  std::string_view rest;
  return read_number(word, value, rest) && rest.empty();
}
bool read(std::string_view word, bool& value) {
  value = word == "true";
  return value || word == "false";
}
bool read(std::string_view word, int64_t& value) {
  double number = 0;
  std::string_view unit;
  if (!read_number(word, number, unit)) return false;
  if (unit == "s")
    number *= 1e6;
  else if (unit == "ms")
    number *= 1e3;
  else if (!unit.empty() && unit != "us")
    return false;
  const double whole = std::nearbyint(number);
  if (!(std::abs(number) < 1e15) || std::abs(number - whole) > 1e-6) return false;
  value = static_cast<int64_t>(whole);
  return true;
}
template <class T>
bool read(std::string_view word, std::optional<T>& value) {
  return read(word, value.emplace());
}
template <class E>
requires std::is_enum_v<E>
bool read(std::string_view word, E& value) {
  for (const auto& [name, known] : words_of(E{})) {
    if (name != word) continue;
    value = known;
    return true;
  }
  return false;
}

// And back.
std::string word_of(int32_t value) {
  return text(value);
}
std::string word_of(double value) {
  return text(value);
}
std::string word_of(bool value) {
  return value ? "true" : "false";
}
std::string word_of(int64_t microseconds) {
  if (microseconds % 1'000'000 == 0) return text(microseconds / 1'000'000, "s");
  if (microseconds % 1'000 == 0) return text(microseconds / 1'000, "ms");
  return text(microseconds, "us");
}
template <class T>
std::string word_of(const std::optional<T>& value) {
  return value ? word_of(*value) : "";
}
template <class E>
requires std::is_enum_v<E> std::string word_of(E value) {
  for (const auto& [name, known] : words_of(E{})) {
    if (known == value) return std::string(name);
  }
  return text("number ", static_cast<int>(value));
}

template <class T>
bool within(T value, T low, T high) {
  return low <= value && value <= high;
}
bool positive(double value) {
  return std::isfinite(value) && value > 0;
}

constexpr const char* kKernelRange = "odd, 3 to 63 (an even number is raised by 1)";
bool legal_kernel(int32_t kernel) {
  return within(kernel, 2, 63);
}
constexpr int32_t odd_kernel(int32_t kernel) {
  return kernel % 2 == 0 ? kernel + 1 : kernel;
}

// The parameters of each representation: name, field, whether its value is legal, what is legal, description.
template <class Visit>
void fields(ScarfParameters& p, Visit visit) {
  visit("preset", p.preset, is_choice(p.preset), choices<Preset>(), "how the patches lie");
  visit("cell", p.grid.cell, within(p.grid.cell.value_or(1), 1, kMaxField), "1 to 128",
        "pixels of a patch's active region");
  const double ratio = p.grid.ratio.value_or(0);
  visit("ratio", p.grid.ratio, std::isfinite(ratio) && ratio >= 0, "a finite number >= 0",
        "reach of a receptive field beyond its cell, in cells; presets paper and event_driven_flex only");
  visit("alpha", p.grid.alpha, positive(p.grid.alpha.value_or(1)), "a finite number > 0",
        "scale of the number of events that a patch keeps");
  visit("accumulation", p.accumulation, positive(p.accumulation), "a finite number > 0",
        "brightness of one event");
}

template <class Visit>
void fields(TimeWindowParameters& p, Visit visit) {
  visit("window", p.window, within<int64_t>(p.window, 1, 100'000'000), "1us to 100s", "length of the window");
  visit("counts", p.counts, true, "true, false", "show how often pixels fired, instead of whether");
  visit("accumulation", p.accumulation, positive(p.accumulation), "a finite number > 0",
        "brightness of one event, with counts");
}

template <class Visit>
void fields(SaeParameters& p, Visit visit) {
  visit("decay", p.decay, is_choice(p.decay), choices<SaeParameters::Decay>(),
        "how brightness falls with age");
  visit("tau", p.tau, within<int64_t>(p.tau, 1, 10'000'000), "1us to 10s",
        "time constant, or length of the linear ramp");
}

template <class Visit>
void fields(ErosParameters& p, Visit visit) {
  visit("kernel", p.kernel, legal_kernel(p.kernel), kKernelRange, "pixels of an event's window, per axis");
  visit("decay", p.decay, p.decay > 0 && p.decay < 1, "a number > 0 and < 1",
        "an event scales its window by decay^(1/kernel)");
}

template <class Visit>
void fields(TosParameters& p, Visit visit) {
  visit("kernel", p.kernel, legal_kernel(p.kernel), kKernelRange, "pixels of an event's window, per axis");
  const double range = odd_kernel(p.kernel) * p.decay;
  visit("decay", p.decay, range > 0 && range < 255, "a number > 0 and < 255 / kernel",
        "levels below 255 - kernel * decay become 0");
}

template <class Visit>
void fields(SitsParameters& p, Visit visit) {
  visit("rule", p.rule, is_choice(p.rule), choices<SitsParameters::Rule>(),
        "which pixels of the window an event weakens");
  visit("kernel", p.kernel, legal_kernel(p.kernel), kKernelRange, "pixels of an event's window, per axis");
}

template <class Visit>
void fields(ChainSaeParameters& p, Visit visit) {
  visit("rule", p.rule, is_choice(p.rule), choices<ChainSaeParameters::Rule>(), "which pixels have a rank");
  visit("linear", p.linear, true, "true, false", "brightness linear in the rank, instead of its 10th power");
}

template <class Visit>
void fields(AedSaeParameters& p, Visit visit) {
  visit("window", p.window, within<int64_t>(p.window, 1'000, 100'000'000), "1ms to 100s",
        "how long events count for the density");
  visit("lambda", p.lambda, positive(p.lambda), "a finite number > 0", "scale of the decay");
}

template <class Visit>
void fields(AaeParameters& p, Visit visit) {
  visit("block", p.block, within(p.block, 1, 1024), "1 to 1024",
        "pixels of a block, per axis; not with esvo2");
  visit("keep", p.keep, true, "true, false", "a query leaves the queues as they are");
  visit("esvo2", p.esvo2, true, "true, false", "8 x 6 blocks, events since the last query");
}

template <class P>
RepresentationInfo described(const char* name, const char* title, const char* description, P defaults) {
  RepresentationInfo info{name, title, description, {}};
  fields(defaults,
         [&info](const char* field, const auto& value, bool, const std::string& range, const char* about) {
           info.parameters.push_back({field, word_of(value), range, about});
         });
  return info;
}

std::vector<RepresentationInfo> make_infos() {
  std::vector<RepresentationInfo> infos = {
      described("scarf", "SCARF", "the last events of overlapping patches, independent of their speed",
                ScarfParameters{.grid = {.cell = 9, .ratio = 1.2, .alpha = 2.0}}),
      described("time_window", "time window", "the pixels that fired within a window of time",
                TimeWindowParameters{}),
      described("sae", "SAE (time surface)", "the time since each pixel last fired", SaeParameters{}),
      described("eros", "EROS", "each event makes its pixel white and scales its window", ErosParameters{}),
      described("tos", "TOS", "each event makes its pixel white and lowers its window, with a threshold",
                TosParameters{}),
      described("sits", "SITS", "each event lowers the newer pixels of its window", SitsParameters{}),
      described("chain_sae", "CHAIN-SAE", "the pixels by the order in which they last fired",
                ChainSaeParameters{}),
      described("aed_sae", "AED-SAE", "a time surface whose decay follows from the density of the events",
                AedSaeParameters{}),
      described("aae", "AAE", "as many of each block's newest events as its activity asks for",
                AaeParameters{}),
  };
  for (RepresentationInfo& info : infos) {
    info.exact = info.name != "aed_sae" && info.name != "aae";
    info.has_events = info.name == "scarf" || info.name == "time_window" || info.name == "aae";
  }
  return infos;
}

// The alternative of Parameters at an index, with its defaults.
template <size_t... I>
Parameters defaults_of(size_t index, std::index_sequence<I...>) {
  Parameters parameters;
  ((I == index ? void(parameters.emplace<I>()) : void()), ...);
  return parameters;
}

std::string names_of(const auto& named) {
  std::string names;
  for (const auto& one : named) names += (names.empty() ? "" : ", ") + one.name;
  return names;
}

}  // namespace

std::span<const RepresentationInfo> representations() {
  static const std::vector<RepresentationInfo> infos = make_infos();
  return infos;
}

const RepresentationInfo& info_of(const Parameters& parameters) {
  return representations()[parameters.index()];
}

Result<Parameters> parse_parameters(const std::string& representation,
                                    const std::map<std::string, std::string>& words) {
  const auto infos = representations();
  size_t index = 0;
  while (index < infos.size() && infos[index].name != representation) ++index;
  if (index == infos.size())
    return illegal(text("representation '", representation, "' is unknown; use one of ", names_of(infos)));

  Parameters parameters = defaults_of(index, std::make_index_sequence<std::variant_size_v<Parameters>>());
  for (const auto& [name, word] : words) {
    bool known = false;
    std::string unreadable;
    const auto take = [&](const char* field, auto& value, bool, const std::string& range, const char*) {
      if (name != field) return;
      known = true;
      if (!read(word, value))
        unreadable = text(representation, ": ", name, " is '", word, "', legal is ", range);
    };
    std::visit([&take](auto& p) { fields(p, take); }, parameters);
    if (!known)
      return illegal(
          text(representation, " has no parameter '", name, "'; it has ", names_of(infos[index].parameters)));
    if (!unreadable.empty()) return illegal(unreadable);
  }
  return checked_parameters(parameters);
}

Result<Parameters> checked_parameters(Parameters parameters) {
  std::string problem;
  const std::string& representation = info_of(parameters).name;
  const auto check = [&](const char* field, const auto& value, bool legal, const std::string& range,
                         const char*) {
    if (legal || !problem.empty()) return;
    problem = text(representation, ": ", field, " is ", word_of(value), ", legal is ", range);
  };
  std::visit(
      [&check](auto& p) {
        fields(p, check);
        if constexpr (requires { p.kernel; }) p.kernel = odd_kernel(p.kernel);
      },
      parameters);
  if (!problem.empty()) return illegal(problem);
  return parameters;
}

}  // namespace scarf
