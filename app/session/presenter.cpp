#include "app/session/presenter.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "app/session/missing_force.h"
#include "experiments/procedures/stimulus.h"

namespace jnd::app {

using namespace experiments;

const PresentationState& Presenter::presentation() const {
  return session_.state().trial(*session_.state().current_trial()).presentations.back();
}

/// The cue is the same whatever the stimulus contains: it depends on the interval's name and
/// never on its level.
void Presenter::give_cue(CueMoment moment) {
  const std::optional<std::int64_t> number = session_.state().current_trial();
  if (sound_ == nullptr || !number) return;
  const TrialState& trial = session_.state().trial(*number);
  sound_->cue(moment, *number, trial.attempt,
              static_cast<std::int64_t>(trial.presentations.size()));
}

void Presenter::stimulus_is_gone() {
  if (std::exchange(is_in_stimulus_, false)) give_cue(CueMoment::kEnd);
}

void Presenter::begin(const Block& block, const std::string& interval, Beginning beginning) {
  session_.begin_presentation(interval, apparatus_.next_tick());
  amounts_ = amounts_of(setting_of(block, interval, presentation().intensity));
  if (beginning == Beginning::kStimulus) {
    counts_forces_ = false;
    told_missing_force_ = false;
  }
  missed_before_ = apparatus_.telemetry().num_missed_ticks;
  limited_before_ = static_cast<std::int64_t>(apparatus_.telemetry().num_limited_ticks);
  apparatus_.render(amounts_, beginning == Beginning::kStep ? Apparatus::Stimulus::kGoesOn
                                                            : Apparatus::Stimulus::kAnother);
  if (interval == "free_space") {
    stimulus_is_gone();
  } else if (!std::exchange(is_in_stimulus_, true) || beginning == Beginning::kStimulus) {
    give_cue(CueMoment::kBegin);
  }
  // The disk may have taken its time; what is felt begins here.
  switched_tick_ = apparatus_.next_tick();
  under_way_ = true;
  measuring_ = false;
}

bool Presenter::waits_for_ramp() const { return under_way_ && !measuring_; }

bool Presenter::ramp_has_passed() const {
  if (apparatus_.realtime_thread() == nullptr) return felt_s() >= needs_.ramp_s;
  // The tick that ran while the command was sent may have missed it, but the next tick has not.
  return apparatus_.next_tick() >= switched_tick_ + 2 && apparatus_.telemetry().ramp_finished;
}

void Presenter::ramp_is_over() {
  const core::Telemetry& now = apparatus_.telemetry();
  sums_before_ = now.contact_sums;
  // Between two steps a hand may rest: they are judged together.
  if (!counts_forces_ && asks_for_force(amounts_)) {
    counts_forces_ = true;
    forces_before_ = now.force_counts;
    ticks_before_ = now.num_ticks;
  }
  apparatus_.meter_strokes();
  measuring_ = true;
}

Presenter::Felt Presenter::end(Afterwards afterwards) {
  core::PresentationMeasures measures;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Felt felt{.delivered_damping_n_s_per_m = kUnknown, .device_damping_n_s_per_m = kUnknown};
  const core::Telemetry last = apparatus_.telemetry();
  felt.last_tick = apparatus_.next_tick() - 1;
  felt.duration_s = static_cast<double>(felt.last_tick - switched_tick_) / needs_.rate_hz;
  if (afterwards == Afterwards::kFreeSpace) {
    apparatus_.render(core::free_space());
    stimulus_is_gone();
  }
  if (measuring_) {
    core::ContactSums sums = last.contact_sums - sums_before_;
    const core::PresentationMeasures moved = apparatus_.finish_strokes();
    // A solid is pressed, and what the hand does along its surface is no stroke. The
    // mean height, which is measured beside strokes, would mean something here: how deep the
    // hand presses. It is dropped all the same, because its column is empty for solids in every
    // stored study. A new measure of pressing gets a column of its own, which is copied from
    // `moved` whether or not a solid is pressed.
    const bool is_pressed = amounts_.plane().is_there();
    if (!is_pressed) measures = moved;
    if (sums.num_ticks == 0 || apparatus_.measures_force()) sums = apparatus_.metered_sums();
    felt.delivered_damping_n_s_per_m = sums.delivered_damping_n_s_per_m();
    // This comes from all motion so far, because within one presentation the forces that
    // accelerate masses would not cancel out.
    felt.device_damping_n_s_per_m = last.contact_sums.device_damping_n_s_per_m();
    if (!is_pressed) measures.delivered_damping_n_s_per_m = felt.delivered_damping_n_s_per_m;
  }
  if (amounts_.is_plain_damping()) {
    measures.commanded_damping_n_s_per_m = amounts_.damping_n_s_per_m;
  }
  felt.num_ticks = felt.last_tick - presentation().first_tick + 1;
  felt.missed_ticks = last.num_missed_ticks - missed_before_;
  measures.missed_ticks = felt.missed_ticks;
  measures.limited_ticks = static_cast<std::int64_t>(last.num_limited_ticks) - limited_before_;
  session_.end_presentation(felt.last_tick,
                            {.measures = measures, .exposure = exposure_since_last()});
  tell_guards();
  if (afterwards != Afterwards::kNextStep) tell_missing_force(last);
  under_way_ = false;
  measuring_ = false;
  return felt;
}

/// The exposure of a simulated hand is stored only if the study asks for it, because nothing
/// can happen to it.
std::optional<core::Exposure> Presenter::exposure_since_last() {
  if (apparatus_.is_simulated() && !session_.limits().limits_exposure()) return std::nullopt;
  const core::Exposure now = apparatus_.telemetry().exposure;
  return now - std::exchange(told_, now);
}

/// Of what is felt for a moment alone nobody can tell. A stimulus of several steps is told of
/// once.
void Presenter::tell_missing_force(const core::Telemetry& last) {
  constexpr double kShortest_s = 0.2;
  if (!counts_forces_ || told_missing_force_) return;
  const auto felt_ticks = static_cast<double>(last.num_ticks - ticks_before_);
  if (!asks_for_force(amounts_) || felt_ticks < kShortest_s * needs_.rate_hz) return;
  const std::string cause = missing_force_cause(last.force_counts - forces_before_);
  if (cause.empty()) return;
  told_missing_force_ = true;
  const std::int64_t number = *session_.state().current_trial();
  const TrialState& trial = session_.state().trial(number);
  session_.force_missing({.trial = number,
                          .attempt = trial.attempt,
                          .presentation = static_cast<std::int64_t>(trial.presentations.size()),
                          .cause = cause});
}

std::string Presenter::missed_reason(const Felt& felt) const {
  const auto missed = static_cast<double>(felt.missed_ticks);
  const auto due = static_cast<double>(felt.num_ticks);
  if (!(missed > needs_.max_missed_ratio * due)) return "";
  return fmt::format(
      "missed ticks: {} of {} never ran, more than the {:g} % that the study "
      "allows",
      felt.missed_ticks, felt.num_ticks, 100.0 * needs_.max_missed_ratio);
}

void Presenter::abandon() {
  stimulus_is_gone();
  const bool metered = std::exchange(measuring_, false);
  under_way_ = false;
  counts_forces_ = false;
  if (metered) (void)apparatus_.finish_strokes();
}

void Presenter::tell_exposure() {
  const std::optional<core::Exposure> exposure = exposure_since_last();
  if (exposure && exposure->force_time_n_s > 0.0) session_.exposed(*exposure);
  tell_guards();
}

/// In simulated time, this is stored only if somebody wants to know what guards would do.
void Presenter::tell_guards() {
  if (apparatus_.realtime_thread() == nullptr && !apparatus_.shadows_guards()) return;
  const core::GuardCounts now = apparatus_.telemetry().guards;
  const core::GuardCounts told = std::exchange(told_guards_, now);
  for (std::size_t i = 0; i < core::kGuards.size(); ++i) {
    const GuardNoticed noticed{.guard = std::string(core::name(core::kGuards[i])),
                               .num_warnings = now.num_warnings[i] - told.num_warnings[i],
                               .num_shadowed = now.num_shadowed[i] - told.num_shadowed[i]};
    if (noticed.num_warnings + noticed.num_shadowed > 0) session_.guard_noticed(noticed);
  }
}

double Presenter::felt_s() const noexcept {
  if (!under_way_) return 0.0;
  return static_cast<double>(apparatus_.next_tick() - switched_tick_) / needs_.rate_hz;
}

}  // namespace jnd::app
