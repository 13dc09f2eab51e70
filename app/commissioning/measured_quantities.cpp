#include "app/commissioning/measured_quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/commissioning/single_mass.h"
#include "app/commissioning/commissioned_profile.h"

namespace jnd::app {
namespace {

using analysis::Measured;

/// So many decimals that two digits of the interval's half width are shown.
int decimals_for(double half_width) {
  if (!(half_width > 0.0)) return 3;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 6);
}

int decimals_of(const Measured& measured, double scale) {
  return decimals_for(0.5 * std::abs(measured.ci95_high - measured.ci95_low) * scale);
}

MeasuredQuantity quantity(const char* what, const Measured& measured, const char* unit,
                          double scale = 1.0) {
  const int decimals = decimals_of(measured, scale);
  return {what, fmt::format("{:.{}f}", scale * measured.value, decimals),
          fmt::format("{:.{}f} to {:.{}f}", scale * measured.ci95_low, decimals,
                      scale * measured.ci95_high, decimals),
          unit};
}

/// Such as "0.902 (0.898 to 0.906)".
std::string with_interval_words(const Measured& measured, double scale = 1.0) {
  const MeasuredQuantity words = quantity("", measured, "", scale);
  return words.estimate + " (" + words.interval + ")";
}

std::vector<MeasuredQuantity> homing_quantities(const analysis::HomingFit& fit) {
  return {{"Places of the tool after each homing, the furthest apart",
           fmt::format("{:.3f}", 1e3 * fit.spread_m), "–", "mm"},
          {"Way of the tool when it was let go of without force",
           fmt::format("{:.1f}", 1e3 * fit.moved_m), "–", "mm"}};
}

std::vector<MeasuredQuantity> noise_quantities(const analysis::NoiseFit& fit) {
  return {
      quantity("Noise of a position on one axis, standard deviation", fit.position_sd_m, "µm",
               1e6),
      {"Least step between two positions",
       fit.position_resolution_m > 0.0 ? fmt::format("{:.3g}", 1e6 * fit.position_resolution_m)
                                       : "none seen",
       "–", "µm"},
      quantity("Noise of a velocity on one axis, standard deviation", fit.velocity_sd_m_per_s,
               "mm/s", 1e3)};
}

std::vector<MeasuredQuantity> frame_quantities(const analysis::FrameFit& fit) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  std::vector<MeasuredQuantity> all;
  for (int axis = 0; axis < 3; ++axis) {
    const double half_m = fit.offset_ci95_m[axis];
    all.push_back(quantity(
        "", {fit.offset_m[axis], fit.offset_m[axis] - half_m, fit.offset_m[axis] + half_m},
        "mm", 1e3));
    all.back().what = fmt::format("Device's origin in the workspace, {}",
                                  kAxes[static_cast<std::size_t>(axis)]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    all.push_back({fmt::format("Device's {} axis in the workspace, as x, y, z",
                               kAxes[static_cast<std::size_t>(axis)]),
                   fmt::format("{:.4f}, {:.4f}, {:.4f}", fit.rotation(0, axis),
                               fit.rotation(1, axis), fit.rotation(2, axis)),
                   "by the turn below", "1"});
  }
  const Eigen::Vector3d turn_mrad = 1e3 * fit.rotation_ci95_rad;
  all.push_back(
      {"Turn that is left open about x, y, z of the workspace", "–",
       fmt::format("±{:.2f}, ±{:.2f}, ±{:.2f}", turn_mrad.x(), turn_mrad.y(), turn_mrad.z()),
       "mrad"});
  all.push_back(
      {fmt::format("How {} marks were met on one axis, standard deviation", fit.num_marks),
       fmt::format("{:.3f}", 1e3 * fit.residual_m), "–", "mm"});
  return all;
}

std::vector<MeasuredQuantity> force_quantities(const analysis::ForceFit& fit) {
  std::vector<MeasuredQuantity> all = {
      quantity("Gain: force given for a newton commanded", fit.gain, "N/N"),
      quantity("Weight that the motors do not carry", fit.weight_n, "N"),
      quantity(fit.damps_alike ? "Own damping" : "Own damping along x", fit.damping_n_s_per_m,
               "N s/m")};
  constexpr std::array<const char*, 3> kNames = {"Own damping along x", "Own damping along y",
                                                 "Own damping along z"};
  for (std::size_t axis = 1;
       !fit.damps_alike && axis < kNames.size() && axis < fit.damping_by_axis_n_s_per_m.size();
       ++axis) {
    all.push_back(quantity(kNames[axis], fit.damping_by_axis_n_s_per_m[axis], "N s/m"));
  }
  all.push_back(quantity("Dry friction", fit.friction_n, "N"));
  all.push_back(quantity("Hysteresis, in newtons commanded", fit.hysteresis_n, "N"));
  all.push_back({"Spread of the gain between poses, standard deviation",
                 fmt::format("{:.2f}", 100.0 * fit.pose_spread_ratio), "–", "%"});
  all.push_back({"Scatter of the ways without loads about the fit, newtons commanded",
                 fmt::format("{:.4f}", fit.residual_n), "–", "N"});
  return all;
}

std::vector<MeasuredQuantity> stability_quantities(const analysis::StabilityFit& fit) {
  return {
      quantity("Damping at which the loop would begin to swing", fit.damping.damping_n_s_per_m,
               "N s/m"),
      {"Frequency of that swing", fmt::format("{:.0f}", fit.damping.frequency_hz), "–", "Hz"},
      {"Thickest fluid that is stable",
       fmt::format("{:.3g}{}", fit.viscosity_pa_s, fit.damping.is_beyond ? " or more" : ""),
       "–", "Pa s"},
      {"Thickest fluid without a fault of the loop", three_digits(fit.quiet_viscosity_pa_s),
       "–", "Pa s"},
      {"Hardest solid that is stable", three_digits(fit.stiffness_n_per_m), "–", "N/m"}};
}

bool is_no_single_mass(const CommissioningResults& results) {
  return results.has(CommissioningStep::kDelay) && results.has(CommissioningStep::kForce) &&
         !analysis::is_single_mass(*results.delay, *results.force);
}

std::vector<MeasuredQuantity> delay_quantities(const CommissioningResults& results) {
  const analysis::DelayFit& fit = *results.delay;
  if (is_no_single_mass(results)) {
    return {
        {"Delay and mass: the device gives way, and is no single mass", "not told", "–", ""}};
  }
  std::vector<MeasuredQuantity> all = {
      quantity("Delay: from a command until its force acts", fit.delay_s, "ms", 1e3)};
  if (results.has(CommissioningStep::kForce)) {
    all.push_back(quantity("Mass that is felt", mass_kg(fit, results.force->gain), "kg"));
  }
  all.push_back(quantity("Mass over gain", fit.mass_per_gain_kg, "kg"));
  return all;
}

std::string gain_words(const Measured& gain) {
  std::string words =
      fmt::format("Of each newton that is commanded, {} N act", with_interval_words(gain));
  const double percent = 100.0 * (gain.value - 1.0);
  if (gain.holds(1.0)) return words + ", which holds a true force.";
  return words + fmt::format(": its force is {:.1f} % too {}.", std::abs(percent),
                             percent > 0.0 ? "strong" : "weak");
}

}  // namespace

std::vector<MeasuredQuantity> quantities_in(CommissioningStep step,
                                            const CommissioningResults& results) {
  if (!results.has(step)) return {};
  switch (step) {
    case CommissioningStep::kHoming:
      return homing_quantities(*results.homing);
    case CommissioningStep::kNoise:
      return noise_quantities(*results.noise);
    case CommissioningStep::kFrame:
      return frame_quantities(*results.frame);
    case CommissioningStep::kForce:
      return force_quantities(*results.force);
    case CommissioningStep::kDelay:
      return delay_quantities(results);
    case CommissioningStep::kStability:
      return stability_quantities(*results.stability);
  }
  return {};
}

std::vector<std::string> main_findings(const CommissioningResults& results) {
  std::vector<std::string> found;
  if (results.has(CommissioningStep::kForce)) {
    const analysis::ForceFit& force = *results.force;
    found.push_back(gain_words(force.gain));
    found.push_back(fmt::format(
        "By itself it opposes motion with {} N s/m of damping, as a fluid would, and {} N of "
        "dry "
        "friction. jnd results --delivered takes gain and damping into account.",
        with_interval_words(force.damping_n_s_per_m), with_interval_words(force.friction_n)));
    found.push_back(
        force.weight_n.value >= 0.0
            ? fmt::format("Its motors leave {} N of its weight to the hand.",
                          with_interval_words(force.weight_n))
            : fmt::format("Its motors lift the hand by {} N.",
                          with_interval_words({-force.weight_n.value, -force.weight_n.ci95_high,
                                               -force.weight_n.ci95_low})));
  }
  if (results.has(CommissioningStep::kStability)) {
    const analysis::StabilityFit& stability = *results.stability;
    found.push_back(fmt::format(
        "It is stable in fluids up to {} Pa s{} and on solids up to {} N/m.{}",
        three_digits(stability.viscosity_pa_s), stability.damping.is_beyond ? " or more" : "",
        three_digits(stability.stiffness_n_per_m),
        stability.quiet_viscosity_pa_s < stability.viscosity_pa_s
            ? fmt::format(" Its velocities are so noisy that the loop ends the force in fluids "
                          "above {} Pa s.",
                          three_digits(stability.quiet_viscosity_pa_s))
            : std::string()));
  }
  if (is_no_single_mass(results)) {
    found.emplace_back(
        "It gives way where it is pushed, so no single delay and no single mass can be told.");
  } else if (results.has(CommissioningStep::kDelay)) {
    found.push_back(fmt::format("A force acts {} ms after its command.",
                                with_interval_words(results.delay->delay_s, 1e3)));
  }
  if (results.has(CommissioningStep::kFrame)) {
    found.push_back(fmt::format(
        "It tells places in the workspace: {} marks were met with a standard deviation of "
        "{:.2f} mm on an axis.",
        results.frame->num_marks, 1e3 * results.frame->residual_m));
  }
  if (results.has(CommissioningStep::kNoise)) {
    found.push_back(fmt::format("At rest a position has {} µm of noise on an axis.",
                                with_interval_words(results.noise->position_sd_m, 1e6)));
  }
  if (results.has(CommissioningStep::kHoming)) {
    const analysis::HomingFit& homing = *results.homing;
    found.push_back(fmt::format(
        "It finds its zero again within {:.2f} mm. {}", 1e3 * homing.spread_m,
        homing.moved_m < analysis::kHeld_m ? "Without force its tool stays where it is."
                                           : "WITHOUT FORCE ITS TOOL MOVES BY ITSELF: support "
                                             "it whenever the force may end."));
  }
  return found;
}

}  // namespace jnd::app
