#include "app/commissioning/daily_check.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/commissioning/device_on_bench.h"
#include "app/commissioning/guided_pushes.h"
#include "app/commissioning/guided_ways.h"
#include "app/language/words.h"
#include "core/error.h"

namespace jnd::app {
namespace {

using analysis::Measured;
using experiments::DeviceProfile;
using experiments::MeasuredValue;

double half_width(const std::array<double, 2>& ci95) noexcept {
  return 0.5 * std::abs(ci95[1] - ci95[0]);
}

Measured as_it_is(double value) {
  return {.value = value, .ci95_low = value, .ci95_high = value};
}

Eigen::Matrix3d rotation_of(const DeviceProfile& profile) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
      profile.frame.rotation.data());
}

Eigen::Vector3d offset_of(const DeviceProfile& profile) {
  return Eigen::Map<const Eigen::Vector3d>(profile.frame.offset_m.data());
}

/// Expects the profile's value, plus and minus the profile's uncertainty and the tolerance.
CheckedQuantity around(CheckedQuantity it, const MeasuredValue& expected, double tolerated) {
  const double open = half_width(expected.ci95) + tolerated;
  it.expected = expected.value;
  it.least = expected.value - open;
  it.most = expected.value + open;
  return it;
}

/// Expects a value that is never below zero and should be no larger than `most`.
CheckedQuantity at_most(CheckedQuantity it, double expected, double most) {
  it.expected = expected;
  it.least = 0.0;
  it.most = most;
  return it;
}

/// How well four marks show a rotation: their least spread in any direction.
double spread(const std::array<Eigen::Vector3d, 4>& marks_m) {
  Eigen::Matrix<double, 3, 4> about;
  for (int i = 0; i < 4; ++i) about.col(i) = marks_m[static_cast<std::size_t>(i)];
  about.colwise() -= about.rowwise().mean().eval();
  return about.jacobiSvd().singularValues()[2];
}

/// The measurement of one device, from the beginning of a check to its end.
class DailyMeasurement {
 public:
  DailyMeasurement(device::HapticDevice& device, device::Bench& bench,
                   const MeasuringPlan& plan, const StepProgress& progress)
      : bench_(bench), plan_(plan), progress_(progress), started_(device, bench, plan) {}

  [[nodiscard]] analysis::NoiseFit noise() {
    progress_(0.0, tr_later("The device rests; nothing may move it."));
    return noise_at_rest(started_);
  }

  [[nodiscard]] analysis::FrameFit frame(const std::vector<Eigen::Vector3d>& marks_m) {
    std::vector<analysis::TouchedMark> touched;
    for (const Eigen::Vector3d& mark_m : marks_m) {
      progress_(0.05 + 0.1 * static_cast<double>(touched.size()), kMarkIsRead);
      touched.push_back(touched_mark(started_, bench_, mark_m));
    }
    return analysis::fit_frame(touched);
  }

  /// Measures the force around the middle of the marks, along the present axes of the
  /// workspace.
  [[nodiscard]] analysis::ForceFit force(const DeviceProfile& profile,
                                         const analysis::FrameFit& frame,
                                         const Eigen::Vector3d& middle_m, double load_kg) {
    constexpr std::array kSpeeds_m_per_s = {0.035, 0.1, 0.21};
    // Most rounds go along x, because only x counts if the axes are damped differently.
    constexpr std::array kRounds = {3, 1, 1};
    constexpr double kLoadedSpeed_m_per_s = 0.035;
    constexpr double kHalfWay_m = 0.08, kLoadedHalfWay_m = 0.05;
    constexpr int kLoadedRounds = 6;

    started_.hold(kSoftHold);
    const Eigen::Matrix3d to_device = frame.rotation.transpose();
    const Eigen::Vector3d home_m = to_device * (middle_m - frame.offset_m);
    const analysis::DelayFit roughly = how_it_moves(profile, home_m);
    GuidedWays ways(started_, plan_, roughly.mass_per_gain_kg.value);
    for (int axis = 0; axis < 3; ++axis) {
      progress_(0.5 + 0.1 * axis, tr_later("The device goes to and fro, with nothing on it."));
      for (int round = 0; round < kRounds.at(static_cast<std::size_t>(axis)); ++round) {
        for (const double speed_m_per_s : kSpeeds_m_per_s) {
          ways.go(home_m, to_device.col(axis), kHalfWay_m, speed_m_per_s, {});
        }
      }
    }
    progress_(0.8, tr_later("The device lifts and lowers a load."));
    started_.act([&] { bench_.hang(load_kg); });
    for (int round = 0; round < kLoadedRounds; ++round) {
      ways.go(home_m, to_device.col(2), kLoadedHalfWay_m, kLoadedSpeed_m_per_s,
              {.load_kg = load_kg});
    }
    // There is no force while the load is taken off.
    started_.run().stop();
    bench_.hang(0.0);
    progress_(1.0, "");
    return analysis::fit_force(ways.ways(roughly.delay_s.value), to_device.col(2),
                               roughly.mass_per_gain_kg.value, plan_.load_uncertainty_ratio);
  }

 private:
  /// How heavy the device is and how late it acts: by the profile, or else by a few pushes.
  [[nodiscard]] analysis::DelayFit how_it_moves(const DeviceProfile& profile,
                                                const Eigen::Vector3d& home_m) {
    if (profile.mechanics.mass_kg && profile.mechanics.mass_kg->value > 0.0 &&
        profile.delay_s) {
      return {.delay_s = as_it_is(profile.delay_s->value),
              .mass_per_gain_kg =
                  as_it_is(profile.mechanics.mass_kg->value / profile.force.gain->value)};
    }
    GuidedPushes pushes(started_, plan_);
    pushes.go(home_m, 3,
              [&](int) { progress_(0.45, tr_later("The device is pushed to and fro.")); });
    return pushes.fit(0.0);
  }

  device::Bench& bench_;
  const MeasuringPlan& plan_;
  const StepProgress& progress_;
  DeviceOnBench started_;
};

void judge_noise(const DeviceProfile& profile, const analysis::NoiseFit& found,
                 std::vector<CheckedQuantity>& all) {
  const double factor = kDailyTolerances.noise_factor;
  // A difference of one step of the position is no noise.
  const double step_m = profile.noise.position_resolution_m.value_or(0.0);
  if (const auto expected_m = profile.noise.position_sd_m) {
    all.push_back(at_most({.name = "position_sd_m",
                           .what = tr_later("Noise of a position at rest"),
                           .unit = "m",
                           .found = found.position_sd_m,
                           .shown_scale = 1e6,
                           .shown_unit = "µm"},
                          *expected_m, factor * *expected_m + step_m));
  }
  if (const auto expected_m_per_s = profile.noise.velocity_sd_m_per_s) {
    all.push_back(at_most({.name = "velocity_sd_m_per_s",
                           .what = tr_later("Noise of a velocity at rest"),
                           .unit = "m/s",
                           .found = found.velocity_sd_m_per_s,
                           .shown_scale = 1e3,
                           .shown_unit = "mm/s"},
                          *expected_m_per_s, factor * *expected_m_per_s + 1e-6));
  }
}

void judge_frame(const DeviceProfile& profile, const analysis::FrameFit& found,
                 const Eigen::Vector3d& middle_m, std::vector<CheckedQuantity>& all) {
  const Eigen::Matrix3d rotation = rotation_of(profile);
  const Eigen::AngleAxisd turn(found.rotation * rotation.transpose());
  const double turned_rad = std::abs(turn.angle());
  const double open_rad = found.rotation_ci95_rad.maxCoeff();
  all.push_back(at_most(
      {.name = "turned_rad",
       .what = tr_later("Turn of the frame"),
       .unit = "rad",
       .found = {.value = turned_rad,
                 .ci95_low = std::max(0.0, turned_rad - open_rad),
                 .ci95_high = turned_rad + open_rad},
       .shown_scale = 57.29577951,
       .shown_unit = "°"},
      0.0, kDailyTolerances.turned_rad + profile.frame.rotation_ci95_rad.value_or(0.0)));
  // Where the touched marks are, by either frame.
  const Eigen::Vector3d touched_m = found.rotation.transpose() * (middle_m - found.offset_m);
  const double shifted_m = (rotation * touched_m + offset_of(profile) - middle_m).norm();
  all.push_back(at_most({.name = "shifted_m",
                         .what = tr_later("Shift of the frame"),
                         .unit = "m",
                         .found = as_it_is(shifted_m),
                         .shown_scale = 1e3,
                         .shown_unit = "mm"},
                        0.0, kDailyTolerances.shifted_m));
}

void judge_force(const DeviceProfile& profile, const analysis::ForceFit& found,
                 std::vector<CheckedQuantity>& all) {
  all.push_back(around({.name = "gain",
                        .what = tr_later("Gain of the force"),
                        .unit = "N/N",
                        .found = found.gain,
                        .shown_unit = "N/N"},
                       *profile.force.gain,
                       kDailyTolerances.gain_ratio * profile.force.gain->value));
  if (const auto& expected = profile.tool.weight_n) {
    all.push_back(around({.name = "weight_n",
                          .what = tr_later("Weight that is not carried"),
                          .unit = "N",
                          .found = found.weight_n,
                          .shown_unit = "N"},
                         *expected, kDailyTolerances.weight_n));
  }
  if (const auto& expected = profile.mechanics.damping_n_s_per_m) {
    all.push_back(around({.name = "damping_n_s_per_m",
                          .what = tr_later("Own damping"),
                          .unit = "N s/m",
                          .found = found.damping_n_s_per_m,
                          .shown_unit = "N s/m"},
                         *expected, kDailyTolerances.damping_n_s_per_m));
  }
  if (const auto& expected = profile.mechanics.friction_n) {
    all.push_back(around({.name = "friction_n",
                          .what = tr_later("Dry friction"),
                          .unit = "N",
                          .found = found.friction_n,
                          .shown_unit = "N"},
                         *expected, kDailyTolerances.friction_n));
  }
}

/// A value that a profile can store: a number with an interval around it; none otherwise.
std::optional<MeasuredValue> kept_value(const Measured& found, double least, double most) {
  const bool is_kept = found.value > least && found.value < most && found.ci95_low > least &&
                       found.ci95_high < most && found.ci95_low <= found.value &&
                       found.value <= found.ci95_high;
  if (!is_kept) return std::nullopt;
  return MeasuredValue{.value = found.value, .ci95 = {found.ci95_low, found.ci95_high}};
}

std::optional<double> kept_number(double found, double most) {
  return found >= 0.0 && found <= most ? std::optional(found) : std::nullopt;
}

experiments::DailyCheck kept_of(const std::vector<CheckedQuantity>& all,
                                const std::string& day) {
  experiments::DailyCheck kept{.checked_on = day, .passed = true};
  for (const CheckedQuantity& one : all) {
    kept.passed = kept.passed && one.passed();
    if (one.name == "gain") kept.gain = kept_value(one.found, 0.0, 10.0);
    if (one.name == "weight_n") kept.weight_n = kept_value(one.found, -100.0, 100.0);
    if (one.name == "damping_n_s_per_m") {
      kept.damping_n_s_per_m = kept_value(one.found, -1000.0, 1000.0);
    }
    if (one.name == "friction_n") kept.friction_n = kept_value(one.found, -100.0, 100.0);
    if (one.name == "turned_rad") kept.turned_rad = kept_number(one.found.value, 3.2);
    if (one.name == "shifted_m") kept.shifted_m = kept_number(one.found.value, 10.0);
    if (one.name == "position_sd_m") kept.position_sd_m = kept_number(one.found.value, 1.0);
    if (one.name == "velocity_sd_m_per_s") {
      kept.velocity_sd_m_per_s = kept_number(one.found.value, 100.0);
    }
  }
  return kept;
}

/// So many decimals that the range can be read precisely enough to decide.
int shown_decimals(const CheckedQuantity& quantity) {
  const double range = quantity.shown_scale * (quantity.most - quantity.least);
  if (!(range > 0.0) || !std::isfinite(range)) return 3;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(range))), 0, 6);
}

}  // namespace

bool CheckedQuantity::passed() const noexcept {
  const double half_open = 0.5 * (found.ci95_high - found.ci95_low);
  return found.value >= least && found.value <= most && half_open <= 0.5 * (most - least);
}

const char* daily_check_to_do() noexcept {
  return tr_later(
      "Home the device as its maker says, take every hand out, and rest its tool on something "
      "that does not move. Then you are asked to touch four marks, to leave the tool free to "
      "move by 10 cm all around, and to hang one known weight from it.");
}

std::vector<Eigen::Vector3d> daily_marks_m(const std::vector<Eigen::Vector3d>& marks_m) {
  constexpr std::size_t kMostTried = 24;
  const std::size_t num = std::min(marks_m.size(), kMostTried);
  if (num < 4) {
    throw core::Error("commission --daily: expected at least four marks, found " +
                      std::to_string(num));
  }
  std::array<Eigen::Vector3d, 4> best_m{};
  double most = -1.0;
  for (std::size_t a = 0; a < num; ++a) {
    for (std::size_t b = a + 1; b < num; ++b) {
      for (std::size_t c = b + 1; c < num; ++c) {
        for (std::size_t d = c + 1; d < num; ++d) {
          const std::array four_m = {marks_m[a], marks_m[b], marks_m[c], marks_m[d]};
          // If several are equal, the first one is taken, whatever rounding says.
          if (const double its = spread(four_m); its > most + 1e-9) {
            most = its;
            best_m = four_m;
          }
        }
      }
    }
  }
  return {best_m.begin(), best_m.end()};
}

DailyCheckResult check_daily(device::HapticDevice& device, device::Bench& bench,
                             const MeasuringPlan& plan, const DeviceProfile& profile,
                             const std::string& day, const StepProgress& progress) {
  if (!profile.force.gain || !(profile.force.gain->value > 0.0)) {
    throw core::Error(profile.name +
                      ": expected a profile with the gain of its force, found none; measure "
                      "the device with `jnd commission`");
  }
  if (plan.loads_kg.empty()) {
    throw core::Error("commission --daily: expected a known load, found none");
  }
  const std::vector<Eigen::Vector3d> marks_m =
      daily_marks_m(plan.marks_m.empty() ? default_marks_m() : plan.marks_m);
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& mark_m : marks_m) middle_m += mark_m / 4.0;

  DailyCheckResult result;
  DailyMeasurement measurement(device, bench, plan, progress);
  const analysis::NoiseFit noise = measurement.noise();
  const analysis::FrameFit frame = measurement.frame(marks_m);
  const analysis::ForceFit force =
      measurement.force(profile, frame, middle_m, *std::ranges::max_element(plan.loads_kg));
  judge_noise(profile, noise, result.quantities);
  judge_frame(profile, frame, middle_m, result.quantities);
  judge_force(profile, force, result.quantities);
  result.kept = kept_of(result.quantities, day);
  return result;
}

std::string found_words(const CheckedQuantity& quantity) {
  const int decimals = shown_decimals(quantity);
  const double scale = quantity.shown_scale;
  std::string value = fmt::format("{:.{}f}", scale * quantity.found.value, decimals);
  if (!(quantity.found.ci95_high > quantity.found.ci95_low)) return value;
  return value + fmt::format(" [{:.{}f}, {:.{}f}]", scale * quantity.found.ci95_low, decimals,
                             scale * quantity.found.ci95_high, decimals);
}

std::string expected_words(const CheckedQuantity& quantity) {
  const int decimals = shown_decimals(quantity);
  const double scale = quantity.shown_scale;
  return fmt::format("{:.{}f} to {:.{}f}", scale * quantity.least, decimals,
                     scale * quantity.most, decimals);
}

}  // namespace jnd::app
