#include "app/operator/trial_intervals.h"

#include <algorithm>

namespace jnd::app {

using namespace experiments;

/// Where the order is drawn, "test" and "reference" are called "first" and "second", or
/// "third".
std::string shown_name(const PresentationState& presented, const PlannedTrial& trial) {
  if (presented.place > 0) return interval_name(static_cast<int>(presented.place));
  if (!trial.test_interval || presented.interval == "free_space") return presented.interval;
  return interval_name((presented.interval == "test") == (*trial.test_interval == 1) ? 1 : 2);
}

const char* interval_name(int place) noexcept {
  return place == 1 ? "first" : place == 2 ? "second" : "third";
}

std::string next_interval(const TrialForm& form, const TrialState& trial) {
  if (!form.order_is_drawn) return "";
  for (int place = 1; place <= form.num_intervals; ++place) {
    if (!trial.under_way || !felt(trial, interval_name(place))) return interval_name(place);
  }
  return "";
}

std::string first_interval(const TrialForm& form) {
  return form.order_is_drawn ? "first" : form.has_reference ? "reference" : "test";
}

std::string last_interval(const TrialForm& form) {
  return form.order_is_drawn ? interval_name(form.num_intervals) : "test";
}

std::string shown_interval(const TrialForm& form, const TrialState& trial) {
  if (trial.presentations.empty()) return "";
  const PresentationState& last = trial.presentations.back();
  return form.order_is_drawn ? shown_name(last, trial.planned) : last.interval;
}

bool felt(const TrialState& trial, const std::string& interval) {
  return std::ranges::any_of(trial.presentations, [&](const PresentationState& presented) {
    return presented.interval == interval || shown_name(presented, trial.planned) == interval;
  });
}

bool can_answer(const TrialForm& form, const TrialState& trial) {
  if (form.order_is_drawn) return trial.under_way && next_interval(form, trial).empty();
  return trial.under_way && felt(trial, first_interval(form)) &&
         felt(trial, last_interval(form));
}

}  // namespace jnd::app
