#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/commissioning/commissioning.h"
#include "app/commissioning/measuring_steps.h"
#include "experiments/device_profile/device_profile.h"

namespace jnd::app {

/// How far a device may be from its profile on another day, in addition to the uncertainty of
/// the profile itself. Each tolerance is several times the uncertainty of the check.
inline constexpr struct DailyTolerances {
  double gain_ratio = 0.03;  ///< A share of the expected gain.
  double weight_n = 0.15;
  double damping_n_s_per_m = 0.25;
  double friction_n = 0.15;
  double turned_rad = 0.0087;  ///< Half a degree.
  double shifted_m = 0.002;    ///< In the middle of the marks.
  /// The greatest factor between the found and the expected standard deviation.
  double noise_factor = 2.0;
} kDailyTolerances;

/// One quantity that was checked. It passes if `least <= found <= most`, and if the check's own
/// uncertainty is smaller than what it has to decide.
struct CheckedQuantity {
  std::string_view name;  ///< The name as in `experiments::DailyCheck`, such as "gain".
  const char* what = "";  ///< Such as "Gain of the force".
  /// The unit of the numbers below, such as "N/N"; "" for none.
  std::string_view unit;
  double expected = 0.0;  ///< By the profile.
  double least = 0.0, most = 0.0;
  /// If no interval is known, both of its ends are the value.
  analysis::Measured found;
  /// How people see the number: times this factor, in this unit.
  double shown_scale = 1.0;
  std::string_view shown_unit;

  /// False if the number is NaN.
  [[nodiscard]] bool passed() const noexcept;
};

struct DailyCheckResult {
  std::vector<CheckedQuantity> quantities;
  experiments::DailyCheck kept;  ///< For the profile, with the day that was given.

  [[nodiscard]] bool passed() const noexcept { return kept.passed; }
};

/// What the person at the device has to do, in sentences.
[[nodiscard]] const char* daily_check_to_do() noexcept;

/// The four of these marks that show a rotation best. Throws `core::Error` for fewer than four
/// marks.
[[nodiscard]] std::vector<Eigen::Vector3d> daily_marks_m(
    const std::vector<Eigen::Vector3d>& marks_m);

/// Compares a device with its profile, in about two minutes: its noise at rest, four marks that
/// are touched, ways to and fro without a load, then up and down with the heaviest load of the
/// plan. What the profile lacks is not checked. `day` is the day of the check, such as
/// "2026-11-25". Throws `core::Error` if the profile has no gain, if the device cannot be
/// started, or if it stopped with a fault; then nothing was checked. Not real time.
[[nodiscard]] DailyCheckResult check_daily(device::HapticDevice& device, device::Bench& bench,
                                           const MeasuringPlan& plan,
                                           const experiments::DeviceProfile& profile,
                                           const std::string& day,
                                           const StepProgress& progress);

/// What was found and what was expected, for people: "0.902 [0.898, 0.906] N/N" and "0.871 to
/// 0.929".
[[nodiscard]] std::string found_words(const CheckedQuantity& quantity);
[[nodiscard]] std::string expected_words(const CheckedQuantity& quantity);

}  // namespace jnd::app
