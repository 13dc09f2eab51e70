#include "experiments/session/trial_course.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace jnd::experiments {
namespace {

using Interval = std::pair<std::int64_t, std::string>;

/// An interval of three is identified by its place, any other by what it holds.
Interval interval_of(const std::string& interval, std::int64_t place) {
  return {place, place > 0 ? "" : interval};
}

bool is_stimulus(const std::string& interval) { return interval != "free_space"; }

int num_intervals_of(const TrialForm& form) {
  if (form.order_is_drawn) return form.num_intervals;
  return form.has_reference ? 2 : 1;
}

}  // namespace

std::optional<std::int64_t> asked_tick(const TrialForm& form, const TrialState& trial) {
  std::set<Interval> felt;
  for (const PresentationState& presented : trial.presentations) {
    if (!is_stimulus(presented.interval)) continue;
    felt.insert(interval_of(presented.interval, presented.place));
    if (static_cast<int>(felt.size()) == num_intervals_of(form)) return presented.first_tick;
  }
  return std::nullopt;
}

bool was_presented(const TrialState& trial, const std::string& interval, std::int64_t place) {
  return is_stimulus(interval) &&
         std::ranges::any_of(trial.presentations, [&](const PresentationState& presented) {
           return interval_of(presented.interval, presented.place) ==
                  interval_of(interval, place);
         });
}

int num_returns(const TrialState& trial) {
  std::set<Interval> felt;
  int num = 0;
  for (const PresentationState& presented : trial.presentations) {
    if (!is_stimulus(presented.interval)) continue;
    num += felt.insert(interval_of(presented.interval, presented.place)).second ? 0 : 1;
  }
  return num;
}

}  // namespace jnd::experiments
