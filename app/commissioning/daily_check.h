#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/commissioning/commissioning.h"
#include "app/commissioning/measuring_steps.h"
#include "experiments/device_profile/device_profile.h"

namespace jnd::app {

/// How far a device may be from its profile on another day, on top of what the profile's own
/// interval leaves open. Each is several times what the check itself leaves open.
inline constexpr struct DailyTolerances {
  double gain_ratio = 0.03;  ///< Of the expected gain.
  double weight_n = 0.15;
  double damping_n_s_per_m = 0.25;
  double friction_n = 0.15;
  double turned_rad = 0.0087;  ///< Half a degree.
  double shifted_m = 0.002;    ///< At the middle of the marks.
  double noise_factor = 2.0;   ///< Times the expected standard deviation, at most.
} kDailyTolerances;

/// One thing that was checked: passed where `least <= found <= most`, and where the check
/// itself left less open than it is to decide.
struct CheckedQuantity {
  std::string_view name;  ///< "gain", as `experiments::DailyCheck` has it.
  const char* what = "";  ///< "Gain of the force"
  std::string_view unit;  ///< "N/N", "": none; of the numbers below.
  double expected = 0.0;  ///< By the profile.
  double least = 0.0, most = 0.0;
  analysis::Measured found;  ///< Both ends are the value where no interval is known.
  /// For people: a number is shown times this, in this unit.
  double shown_scale = 1.0;
  std::string_view shown_unit;

  /// False for what is no number.
  [[nodiscard]] bool passed() const noexcept;
};

struct DailyCheckResult {
  std::vector<CheckedQuantity> quantities;
  experiments::DailyCheck kept;  ///< For the profile, of the day that was given.

  [[nodiscard]] bool passed() const noexcept { return kept.passed; }
};

/// What is wanted of whoever stands at the device; sentences.
[[nodiscard]] const char* daily_check_to_do() noexcept;

/// The four of these marks that tell a turn best. Throws `core::Error` for fewer than four.
[[nodiscard]] std::vector<Eigen::Vector3d> daily_marks_m(
    const std::vector<Eigen::Vector3d>& marks_m);

/// Compares a device with its profile, in about two minutes: its noise at rest, four marks that
/// are touched, ways to and fro with nothing on it, then up and down with the heaviest load of
/// the plan. What the profile does not have is not checked. `day`: "2026-11-25", of the check.
/// Throws `core::Error` where the profile has no gain, the device cannot be started, or stopped
/// with a fault: then nothing was checked. Not real time.
[[nodiscard]] DailyCheckResult check_daily(device::HapticDevice& device, device::Bench& bench,
                                           const MeasuringPlan& plan,
                                           const experiments::DeviceProfile& profile,
                                           const std::string& day,
                                           const StepProgress& progress);

/// "0.902 [0.898, 0.906] N/N" and "0.871 to 0.929", for people.
[[nodiscard]] std::string found_words(const CheckedQuantity& quantity);
[[nodiscard]] std::string expected_words(const CheckedQuantity& quantity);

}  // namespace jnd::app
