#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commissioning/commissioning.h"

namespace jnd::app {
namespace {

constexpr std::array<StepWords, kCommissioningSteps.size()> kWords = {{
    {"noise", "Noise and resolution",
     "Home the device as its maker says, take every hand out, and rest its tool on something "
     "that "
     "does not move, brakes on."},
    {"frame", "Frame, by touching marks",
     "Bring the tool's first contact point to each mark in turn, and hold it there for 3 "
     "seconds."},
    {"force", "Force, weight and friction",
     "Leave the tool free to move by 10 cm all around. It goes to and fro by itself, then you "
     "are "
     "asked to hang known weights from it."},
    {"delay", "Delay and mass",
     "Leave the tool free to move by 10 cm all around. It is pushed to and fro by 4 N."},
}};

/// Three digits of what the interval leaves open.
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
  return {};
}

std::vector<FoundLine> found_in(CommissioningStep step, const CommissioningResults& results) {
  if (!results.has(step)) return {};
  switch (step) {
    case CommissioningStep::kNoise:
      return {{"Noise of a position, one axis",
               with_interval(results.noise->position_sd_m, 1e6), "um"},
              {"Least step of a position",
               fmt::format("{:.3g}", 1e6 * results.noise->position_resolution_m), "um"},
              {"Noise of a velocity, one axis",
               with_interval(results.noise->velocity_sd_m_per_s, 1e3), "mm/s"}};
    case CommissioningStep::kFrame: {
      const analysis::FrameFit& fit = *results.frame;
      return {{"Device's origin in the workspace",
               fmt::format("{:.4f}, {:.4f}, {:.4f}", fit.offset_m.x(), fit.offset_m.y(),
                           fit.offset_m.z()),
               "m"},
              {"Open in it, 95 %",
               fmt::format("{:.2f}, {:.2f}, {:.2f}", 1e3 * fit.offset_ci95_m.x(),
                           1e3 * fit.offset_ci95_m.y(), 1e3 * fit.offset_ci95_m.z()),
               "mm"},
              {"Open in its turn, 95 %",
               fmt::format("{:.2f}, {:.2f}, {:.2f}", 1e3 * fit.rotation_ci95_rad.x(),
                           1e3 * fit.rotation_ci95_rad.y(), 1e3 * fit.rotation_ci95_rad.z()),
               "mrad"},
              {fmt::format("How {} marks were met, one axis", fit.num_marks),
               fmt::format("{:.2f}", 1e3 * fit.residual_m), "mm"}};
    }
    case CommissioningStep::kDelay:
      return {
          {"From a command until its force acts", with_interval(results.delay->delay_s, 1e3),
           "ms"},
          {"Mass, in newtons commanded", with_interval(results.delay->mass_per_gain_kg), "kg"}};
    case CommissioningStep::kForce:
      return {
          {"Force given for a newton commanded", with_interval(results.force->gain), "N/N"},
          {"Weight that is not carried", with_interval(results.force->weight_n), "N"},
          {"Own damping", with_interval(results.force->damping_n_s_per_m), "N s/m"},
          {"Dry friction", with_interval(results.force->friction_n), "N"},
          {"Hysteresis, in newtons commanded", with_interval(results.force->hysteresis_n), "N"},
          {"Spread of the gain between poses",
           fmt::format("{:.2f}", 100.0 * results.force->pose_spread_ratio), "%"}};
  }
  return {};
}

}  // namespace jnd::app
