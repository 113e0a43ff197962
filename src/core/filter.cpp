// Parameters of the noise filters, and filters behind each other.
#include "scarf/core/filter.h"

#include "core/fields.h"

namespace scarf {
namespace {

constexpr int64_t kLongestPeriod = 1'000'000'000;

}  // namespace

template <class Visit>
void fields(SupportFilter& p, Visit visit) {
  visit(between("range", p.range, 1, 7, "pixels around the event that may support it"));
  visit(between("period", p.period, 1, kLongestPeriod, "how old the support may be"));
}

template <class Visit>
void fields(RefractoryFilter& p, Visit visit) {
  visit(
      between("period", p.period, 1, kLongestPeriod, "how long a pixel is blind after an event that passed"));
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
  return as_result([&]() -> Result<FilterParameters> {
    const auto named = split_words("filter", words);
    if (!named) return named.error();
    const auto parameters = read_alternative<FilterParameters>("filter", filters(), *named);
    return parameters ? checked_filter(*parameters) : parameters;
  });
}

Result<FilterParameters> checked_filter(const FilterParameters& parameters) {
  return as_result([&] { return checked_alternative(parameters); });
}

Result<std::span<const Event>> FilterChain::filter(std::span<const Event> events) {
  return as_result([&]() -> Result<std::span<const Event>> {
    if (incomplete_) {
      return Error{ErrorCode::refused_batch,
                   "the filters are incomplete, since one behind the first failed; reset them"};
    }
    for (const auto& filter : filters_) {
      back_.clear();
      const auto kept = filter->filter(events, back_);
      if (!kept) return kept.error();
      std::swap(front_, back_);
      events = front_;
      incomplete_ = true;  // until all have seen the batch
    }
    incomplete_ = false;
    return events;
  });
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
  incomplete_ = false;
  return {};
}

}  // namespace scarf
