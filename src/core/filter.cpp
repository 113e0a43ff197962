// Parameters of the noise filters, and filters behind each other.
#include "scarf/filter.h"

#include "core/fields.h"

namespace scarf {
namespace {

constexpr int64_t kLongestPeriod = 1'000'000'000;

}  // namespace

template <class Visit>
void visit_fields(SupportFilter& p, Visit visit) {
  visit(number_field("range", 1, 7, "pixels around the event that may support it"), p.range);
  visit(time_field("period", 1, kLongestPeriod, "how old the support may be"), p.period);
}

template <class Visit>
void visit_fields(RefractoryFilter& p, Visit visit) {
  visit(time_field("period", 1, kLongestPeriod, "how long a pixel is blind after an event that passed"),
        p.period);
}

std::span<const FilterInfo> filters() {
  static const std::vector<FilterInfo> infos = {
      {"support", "an event passes if one of the same polarity fell near it shortly before",
       describe_fields<SupportFilter>()},
      {"refractory", "an event passes if its pixel let none pass shortly before",
       describe_fields<RefractoryFilter>()},
  };
  return infos;
}

const FilterInfo& info_of(const FilterParameters& parameters) {
  return filters()[parameters.index()];
}

Result<FilterParameters> parse_filter(const std::string& words) {
  const auto parts = split_words("filter", words);
  if (!parts) return parts.error();
  const auto read = [&]<class Parameters>(Parameters) -> Result<FilterParameters> {
    auto parameters = read_fields<Parameters>("filter " + parts->name, parts->words);
    if (!parameters) return parameters.error();
    return FilterParameters(*parameters);
  };
  if (parts->name == "support") return read(SupportFilter{});
  if (parts->name == "refractory") return read(RefractoryFilter{});
  std::vector<std::string> known;
  for (const FilterInfo& info : filters()) known.push_back(info.name);
  return unknown_name("filter", parts->name, known);
}

Result<FilterParameters> checked_filter(const FilterParameters& parameters) {
  const std::string subject = "filter " + info_of(parameters).name;
  const auto result = std::visit([&](const auto& p) { return check_fields(subject, p); }, parameters);
  if (!result) return result.error();
  return parameters;
}

Result<std::span<const Event>> FilterChain::filter(std::span<const Event> events) {
  for (const auto& filter : filters_) {
    back_.clear();
    const auto kept = filter->filter(events, back_);
    if (!kept) return kept.error();
    std::swap(front_, back_);
    events = front_;
  }
  return events;
}

std::vector<FilterReport> FilterChain::reports() const {
  std::vector<FilterReport> reports;
  for (const auto& filter : filters_) reports.push_back(filter->report());
  return reports;
}

Result<void> FilterChain::reset() {
  for (const auto& filter : filters_) {
    if (auto r = filter->reset(); !r) return r;
  }
  return {};
}

}  // namespace scarf
