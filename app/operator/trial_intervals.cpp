#include "app/operator/trial_intervals.h"

#include <algorithm>

namespace jnd::app {

using namespace experiments;

namespace {

/// "test" and "reference" are "first" and "second" where the trial has an order drawn.
std::string name_of(const std::string& stimulus, const PlannedTrial& trial) {
  if (!trial.test_interval || stimulus == "free_space") return stimulus;
  return (stimulus == "test") == (*trial.test_interval == 1) ? "first" : "second";
}

}  // namespace

std::string first_interval(const TrialForm& form) {
  return form.order_is_drawn ? "first" : form.has_reference ? "reference" : "test";
}

std::string last_interval(const TrialForm& form) {
  return form.order_is_drawn ? "second" : "test";
}

std::string shown_interval(const TrialForm& form, const TrialState& trial) {
  if (trial.presentations.empty()) return "";
  const std::string& stimulus = trial.presentations.back().interval;
  return form.order_is_drawn ? name_of(stimulus, trial.planned) : stimulus;
}

bool felt(const TrialState& trial, const std::string& interval) {
  return std::ranges::any_of(trial.presentations, [&](const PresentationState& presented) {
    return presented.interval == interval ||
           name_of(presented.interval, trial.planned) == interval;
  });
}

bool can_answer(const TrialForm& form, const TrialState& trial) {
  return trial.under_way && felt(trial, first_interval(form)) &&
         felt(trial, last_interval(form));
}

}  // namespace jnd::app
