#include "app/presenter.h"

#include <limits>

#include "experiments/session/stimulus.h"

namespace jnd::app {

using namespace experiments;

const PresentationState& Presenter::presentation() const {
  return session_.state().trial(*session_.state().current_trial()).presentations.back();
}

void Presenter::begin(const Block& block, const std::string& interval) {
  first_tick_ = apparatus_.next_tick();
  session_.begin_presentation(interval, first_tick_);
  amounts_ = amounts_of(setting_of(block, interval, presentation().intensity));
  limited_before_ = static_cast<std::int64_t>(apparatus_.telemetry().num_limited_ticks);
  apparatus_.render(amounts_);
  under_way_ = true;
  measuring_ = false;
}

bool Presenter::waits_for_ramp() const { return under_way_ && !measuring_; }

bool Presenter::ramp_has_passed() const { return felt_s() >= needs_.ramp_s; }

void Presenter::ramp_is_over() {
  sums_before_ = apparatus_.telemetry().contact_sums;
  apparatus_.meter_strokes();
  measuring_ = true;
}

Presenter::Felt Presenter::end() {
  PresentationSummary summary;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Felt felt{.delivered_damping_n_s_per_m = kUnknown, .device_damping_n_s_per_m = kUnknown};
  if (measuring_) {
    core::ContactSums sums = apparatus_.telemetry().contact_sums - sums_before_;
    const analysis::StrokeSummary strokes = apparatus_.finish_strokes();
    summary.stroke_width_m = strokes.stroke_width_m;
    summary.max_speed_m_per_s = strokes.max_speed_m_per_s;
    summary.mean_height_m = strokes.mean_height_m;
    summary.num_strokes = strokes.num_strokes;
    summary.finger_lag_s = apparatus_.metered_finger_lag_s();
    if (sums.num_ticks == 0) sums = apparatus_.metered_sums();
    felt.delivered_damping_n_s_per_m = sums.delivered_damping_n_s_per_m();
    // Of all its motion so far: in one presentation the masses' pushing would not cancel out.
    felt.device_damping_n_s_per_m =
        apparatus_.telemetry().contact_sums.device_damping_n_s_per_m();
    summary.delivered_damping_n_s_per_m = felt.delivered_damping_n_s_per_m;
  }
  if (amounts_.is_plain_damping()) {
    summary.commanded_damping_n_s_per_m = amounts_.damping_n_s_per_m;
  }
  summary.limited_ticks =
      static_cast<std::int64_t>(apparatus_.telemetry().num_limited_ticks) - limited_before_;
  felt.last_tick = apparatus_.next_tick() - 1;
  felt.duration_s = static_cast<double>(felt.last_tick - first_tick_) / needs_.rate_hz;
  session_.end_presentation(felt.last_tick, summary);
  under_way_ = false;
  measuring_ = false;
  return felt;
}

void Presenter::abandon() {
  if (measuring_) (void)apparatus_.finish_strokes();
  under_way_ = false;
  measuring_ = false;
}

double Presenter::felt_s() const noexcept {
  if (!under_way_) return 0.0;
  return static_cast<double>(apparatus_.next_tick() - first_tick_) / needs_.rate_hz;
}

}  // namespace jnd::app
