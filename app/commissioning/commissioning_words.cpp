#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/commissioning/single_mass.h"
#include "app/commissioning/commissioning.h"
#include "app/language/words.h"

namespace jnd::app {
namespace {

constexpr std::array<StepWords, kCommissioningSteps.size()> kWords = {{
    {"homing", tr_later("Homing and brakes"),
     tr_later("Take every hand out and rest the tool on something that does not move. You are "
              "asked to home the device three times and to put the tool back there, then to "
              "take the support away: the device has no force in this step.")},
    {"noise", tr_later("Noise and resolution"),
     tr_later("Take every hand out, and rest the tool on something that does not move, brakes "
              "on.")},
    {"frame", tr_later("Frame, by touching marks"),
     tr_later(
         "Bring the tool's first contact point to each mark in turn, and hold it there for "
         "3 seconds.")},
    {"force", tr_later("Force, weight and friction"),
     tr_later("Leave the tool free to move by 10 cm all around. It goes to and fro by itself, "
              "then you are asked to hang known weights from it.")},
    {"delay", tr_later("Delay and mass"),
     tr_later("Leave the tool free to move by 10 cm all around. It is pushed to and fro by "
              "4 N.")},
    {"stability", tr_later("Stability, by sweeps and stimuli"),
     tr_later(
         "Leave the tool free to move by 25 cm all around, and keep away. It hums as it goes "
         "to and fro, is drawn through thick fluids, and falls onto something solid that is "
         "not there.")},
}};

/// The value and its interval, with so many decimals that two digits of the interval's half
/// width are shown.
std::string with_interval(const analysis::Measured& measured, double scale = 1.0) {
  const double half_width = 0.5 * std::abs(measured.ci95_high - measured.ci95_low) * scale;
  const int decimals =
      half_width > 0.0
          ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 6)
          : 3;
  return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", scale * measured.value, decimals,
                     scale * measured.ci95_low, decimals, scale * measured.ci95_high, decimals);
}

}  // namespace

std::string three_digits(double value) {
  constexpr double kWhole = 100.0;
  if (value < kWhole) return fmt::format("{:.3g}", value);
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return fmt::format("{:.0f}", step * std::round(value / step));
}

const StepWords& words_of(CommissioningStep step) noexcept {
  return kWords[static_cast<std::size_t>(step)];
}

std::optional<CommissioningStep> step_named(std::string_view name) noexcept {
  for (const CommissioningStep step : kCommissioningSteps) {
    if (words_of(step).name == name) return step;
  }
  return std::nullopt;
}

std::vector<CommissioningStep> steps_before(CommissioningStep step) {
  if (step == CommissioningStep::kForce) return {CommissioningStep::kFrame};
  if (step == CommissioningStep::kDelay) {
    return {CommissioningStep::kFrame, CommissioningStep::kForce};
  }
  if (step == CommissioningStep::kStability) {
    return {CommissioningStep::kNoise, CommissioningStep::kFrame, CommissioningStep::kForce,
            CommissioningStep::kDelay};
  }
  return {};
}

std::vector<FoundLine> found_in(CommissioningStep step, const CommissioningResults& results) {
  if (!results.has(step)) return {};
  switch (step) {
    case CommissioningStep::kHoming:
      return {{tr_later("Places after homing, furthest apart"),
               fmt::format("{:.3g}", 1e3 * results.homing->spread_m), "mm"},
              {tr_later("Moved when let go of without force"),
               fmt::format("{:.2g}", 1e3 * results.homing->moved_m), "mm"},
              {tr_later("Without force its tool"),
               results.homing->moved_m < analysis::kHeld_m
                   ? tr_later("stays where it is")
                   : tr_later("moves by itself: support it whenever its force may end"),
               ""}};
    case CommissioningStep::kNoise:
      return {{tr_later("Noise of a position, one axis"),
               with_interval(results.noise->position_sd_m, 1e6), "µm"},
              {tr_later("Least step of a position"),
               fmt::format("{:.3g}", 1e6 * results.noise->position_resolution_m), "µm"},
              {tr_later("Noise of a velocity, one axis"),
               with_interval(results.noise->velocity_sd_m_per_s, 1e3), "mm/s"}};
    case CommissioningStep::kFrame: {
      const analysis::FrameFit& fit = *results.frame;
      return {{tr_later("Device's origin in the workspace"),
               fmt::format("{:.4f}, {:.4f}, {:.4f}", fit.offset_m.x(), fit.offset_m.y(),
                           fit.offset_m.z()),
               "m"},
              {tr_later("Open in it, 95 %"),
               fmt::format("{:.2f}, {:.2f}, {:.2f}", 1e3 * fit.offset_ci95_m.x(),
                           1e3 * fit.offset_ci95_m.y(), 1e3 * fit.offset_ci95_m.z()),
               "mm"},
              {tr_later("Open in its turn, 95 %"),
               fmt::format("{:.2f}, {:.2f}, {:.2f}", 1e3 * fit.rotation_ci95_rad.x(),
                           1e3 * fit.rotation_ci95_rad.y(), 1e3 * fit.rotation_ci95_rad.z()),
               "mrad"},
              {tr_later("How well the marks were met, one axis"),
               fmt::format("{:.2f}", 1e3 * fit.residual_m), "mm"}};
    }
    case CommissioningStep::kDelay:
      if (!analysis::is_single_mass(*results.delay, *results.force)) {
        return {{tr_later("From a command until its force acts"),
                 tr_later("not told: it gives way where it is pushed, and is no single mass"),
                 ""}};
      }
      return {{tr_later("From a command until its force acts"),
               with_interval(results.delay->delay_s, 1e3), "ms"},
              {tr_later("Mass, in newtons commanded"),
               with_interval(results.delay->mass_per_gain_kg), "kg"}};
    case CommissioningStep::kForce: {
      const analysis::ForceFit& fit = *results.force;
      std::vector<FoundLine> lines = {
          {tr_later("Force given for a newton commanded"), with_interval(fit.gain), "N/N"},
          {tr_later("Weight that is not carried"), with_interval(fit.weight_n), "N"},
          {fit.damps_alike ? tr_later("Own damping") : tr_later("Own damping along x"),
           with_interval(fit.damping_n_s_per_m), "N s/m"}};
      constexpr std::array kAxes = {tr_later("Own damping along x"),
                                    tr_later("Own damping along y"),
                                    tr_later("Own damping along z")};
      for (std::size_t axis = 1; !fit.damps_alike && axis < kAxes.size() &&
                                 axis < fit.damping_by_axis_n_s_per_m.size();
           ++axis) {
        lines.push_back(
            {kAxes[axis], with_interval(fit.damping_by_axis_n_s_per_m[axis]), "N s/m"});
      }
      lines.push_back({tr_later("Dry friction"), with_interval(fit.friction_n), "N"});
      lines.push_back(
          {tr_later("Hysteresis, in newtons commanded"), with_interval(fit.hysteresis_n), "N"});
      lines.push_back({tr_later("Spread of the gain between poses"),
                       fmt::format("{:.2f}", 100.0 * fit.pose_spread_ratio), "%"});
      return lines;
    }
    case CommissioningStep::kStability: {
      const analysis::StabilityFit& fit = *results.stability;
      return {{tr_later("Stable in fluids up to"),
               three_digits(fit.viscosity_pa_s) + (fit.damping.is_beyond ? " or more" : ""),
               "Pa s"},
              {tr_later("Where it would begin to swing"),
               fmt::format("{:.0f}", fit.damping.frequency_hz), "Hz"},
              {tr_later("Drawn without a fault through fluids up to"),
               three_digits(fit.quiet_viscosity_pa_s), "Pa s"},
              {tr_later("Stable on solids up to"), three_digits(fit.stiffness_n_per_m), "N/m"}};
    }
  }
  return {};
}

}  // namespace jnd::app
