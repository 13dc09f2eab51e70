#include <string>

#include "app/operator/operated_session.h"
#include "app/operator/trial_intervals.h"
#include "experiments/procedures/procedure.h"
#include "experiments/session/trial_course.h"

// What a pressed pedal or button asks of a session.

namespace jnd::app {

using namespace experiments;

namespace {

constexpr char kStepAction[] = "step_";

/// The interval that comes next without a choice: the first that was not felt yet.
std::string interval_after(const TrialForm& form, const TrialState& trial) {
  if (!trial.under_way) return first_interval(form);
  if (form.order_is_drawn) return next_interval(form, trial);
  if (form.has_reference && !felt(trial, "reference")) return "reference";
  return felt(trial, "test") ? "" : "test";
}

/// The value of the answer that an action gives; none if the action gives no answer of this
/// kind.
std::optional<double> value_of(const std::string& action, AnswerKind kind) {
  if (kind == AnswerKind::kYesNo) {
    if (action == "yes" || action == "first") return 1.0;
    if (action == "no" || action == "second") return 0.0;
  }
  if (kind == AnswerKind::kInterval) {
    if (action == "first") return 1.0;
    if (action == "second") return 2.0;
    if (action == "third") return 3.0;
  }
  if (kind == AnswerKind::kStep && action.starts_with(kStepAction)) {
    return std::stod(action.substr(sizeof kStepAction - 1));
  }
  if (kind == AnswerKind::kMatch && action == "matches") return 0.0;
  return std::nullopt;
}

std::optional<operate::Adjust> step_of(const std::string& action, std::int64_t trial) {
  using enum Direction;
  using enum StepSize;
  if (action == "lower") return operate::Adjust{trial, kLower, kCoarse};
  if (action == "raise") return operate::Adjust{trial, kRaise, kCoarse};
  if (action == "lower_fine") return operate::Adjust{trial, kLower, kFine};
  if (action == "raise_fine") return operate::Adjust{trial, kRaise, kFine};
  return std::nullopt;
}

}  // namespace

std::optional<OperatorRequest> OperatedSession::meaning_of(
    const operate::UseControl& use) const {
  const Step now = step();
  const std::optional<std::int64_t> number = state().current_trial();
  if ((now != Step::kReady && now != Step::kPresenting) || !number || block() == nullptr) {
    return std::nullopt;
  }
  const TrialState& trial = state().trial(*number);
  const TrialForm form = session_.current_form();
  if (use.action == "present") {
    const std::string next = interval_after(form, trial);
    if (next.empty()) return std::nullopt;
    return operate::Present{*number, next};
  }
  if (now != Step::kPresenting || !can_answer(form, trial)) return std::nullopt;
  if (const auto moved = step_of(use.action, *number); moved && form.adjustable) return *moved;
  const bool cannot_tell = use.action == "cannot_tell" && block()->cannot_tell;
  const std::optional<double> value = value_of(use.action, form.answer);
  if (!value && !cannot_tell) return std::nullopt;
  return operate::Answer{
      .trial = *number, .value = value, .control = use.control, .pressed_ns = use.pressed_ns};
}

double OperatedSession::given_before_s(const operate::Answer& answer) const {
  const core::Sample& newest = running_.apparatus().telemetry().sample;
  // In simulated time, ticks have no time of the clock by which presses are timed.
  if (answer.pressed_ns == 0 || newest.monotonic_ns == 0) return 0.0;
  const double tick_s = 1.0 / parameters_.study.device.rate_hz;
  return tick_s + 1e-9 * static_cast<double>(newest.monotonic_ns - answer.pressed_ns);
}

}  // namespace jnd::app
