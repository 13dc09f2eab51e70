#include "app/operator/given_answer.h"

#include <map>
#include <string>

#include "app/operator/trial_intervals.h"

namespace jnd::app {
namespace {

using namespace experiments;

/// The last answer of this block before the trial's own, if it is a magnitude.
std::optional<double> magnitude_before(const AnswerGiven& given) {
  const TrialState& trial = given.trial;
  std::int64_t latest = 0;
  std::optional<double> value;
  for (const TrialState& other : given.state.trials) {
    const bool is_before = !trial.is_answered || other.answer_sequence < trial.answer_sequence;
    if (&other == &trial || other.stage != trial.stage || !other.is_answered || !is_before ||
        other.answer_sequence <= latest) {
      continue;
    }
    latest = other.answer_sequence;
    value = other.response;
  }
  return value;
}

/// The whole strokes in each stimulus of the attempt that is not a solid, by the stimulus's
/// name.
std::map<std::string, std::int64_t> strokes_in(const AnswerGiven& given) {
  std::map<std::string, std::int64_t> strokes;
  for (const PresentationState& presented : given.trial.presentations) {
    if (presented.interval == "free_space" || given.block.is_pressed_in(presented.interval)) {
      continue;
    }
    strokes[shown_name(presented, given.trial.planned)] +=
        presented.last_tick ? presented.num_strokes : given.felt.num_strokes;
  }
  return strokes;
}

}  // namespace

GivenAnswer AnswerGiven::with(AnswerKind kind, const std::optional<double>& value) const {
  GivenAnswer answer{.kind = kind, .value = value, .last_value = magnitude_before(*this)};
  if (!hides_levels) {
    for (const auto& [interval, num] : strokes_in(*this)) {
      if (num == 0) answer.unstroked.push_back(interval);
    }
  }
  if (trial.presentations.empty()) return answer;
  // The time in the whole attempt counts, because somebody who returns to a stimulus decides
  // sooner.
  const PresentationState& last = trial.presentations.back();
  double felt_s = 0.0;
  for (const PresentationState& presented : trial.presentations) {
    if (shown_name(presented, trial.planned) != shown_name(last, trial.planned)) continue;
    const std::int64_t end = presented.last_tick.value_or(felt.next_tick - 1);
    felt_s += static_cast<double>(end - presented.first_tick) / rate_hz;
  }
  if (last.interval != "free_space") answer.felt_s = felt_s;
  return answer;
}

}  // namespace jnd::app
