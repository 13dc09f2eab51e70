#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commissioning/measuring_steps.h"
#include "device/haptic_device.h"

namespace jnd::app {

/// What is measured of a device before a hand is in it, in this order.
enum class CommissioningStep { kHoming, kNoise, kFrame, kForce, kDelay, kStability };

inline constexpr std::array kCommissioningSteps = {
    CommissioningStep::kHoming, CommissioningStep::kNoise, CommissioningStep::kFrame,
    CommissioningStep::kForce,  CommissioningStep::kDelay, CommissioningStep::kStability};

/// How a step is called and what somebody has to do for it.
struct StepWords {
  std::string_view name;  ///< "force", as options and records spell it.
  const char* title;      ///< "Force, weight and friction"
  const char* to_do;      ///< What is wanted of whoever stands at the device; sentences.
};
[[nodiscard]] const StepWords& words_of(CommissioningStep step) noexcept;
/// None of them has this name: nothing.
[[nodiscard]] std::optional<CommissioningStep> step_named(std::string_view name) noexcept;
/// The steps that have to be measured before, for their results are used.
[[nodiscard]] std::vector<CommissioningStep> steps_before(CommissioningStep step);

/// Which device it is, as it says when it is open.
struct CommissionedDevice {
  std::string name;  ///< As after `--device`.
  device::DeviceIdentity identity;
  device::DeviceCapabilities can;
};

/// What was measured so far, by the newest measurement of each step.
struct CommissioningResults {
  std::optional<analysis::HomingFit> homing;
  std::optional<analysis::NoiseFit> noise;
  std::optional<analysis::FrameFit> frame;
  std::optional<analysis::DelayFit> delay;
  std::optional<analysis::ForceFit> force;
  std::optional<analysis::StabilityFit> stability;
  /// When each was measured, "2026-11-25T10:12:00Z"; "" where it was not.
  std::array<std::string, kCommissioningSteps.size()> measured_at;

  /// Under what each was measured; none: the record does not say.
  std::array<std::optional<MeasuringConditions>, kCommissioningSteps.size()> conditions;

  [[nodiscard]] bool has(CommissioningStep step) const noexcept {
    return !measured_at[static_cast<std::size_t>(step)].empty();
  }
};

/// A device that is being commissioned, step by step, with a record of all that was measured: a
/// file of one JSON document a line, to which lines are only ever added. Each line is on disk
/// before the next step begins, so an interruption at any step keeps what was measured, and the
/// same file goes on from there. Not real time; used by one thread.
class Commissioning {
 public:
  /// Begins a record, or goes on with it. Throws `core::Error`: it is damaged, or of another
  /// device.
  Commissioning(std::filesystem::path record, CommissionedDevice device, MeasuringPlan plan);

  /// Measures this step anew and keeps it. What was measured before by a step that uses it is
  /// not used any more. Throws `core::Error` where a step before is missing, and as the
  /// measurement does; then nothing is kept of it but that it failed, and why.
  void measure(CommissioningStep step, device::HapticDevice& device, device::Bench& bench,
               const StepProgress& progress);
  /// The step counts as not measured, and so do those that use it.
  void undo(CommissioningStep step);

  [[nodiscard]] const CommissioningResults& results() const noexcept { return results_; }
  [[nodiscard]] const CommissionedDevice& device() const noexcept { return device_; }
  [[nodiscard]] const MeasuringPlan& plan() const noexcept { return plan_; }
  [[nodiscard]] const std::filesystem::path& record() const noexcept { return record_; }
  /// The first that is not measured; none: it is complete.
  [[nodiscard]] std::optional<CommissioningStep> next_step() const noexcept;

 private:
  void read_record();
  void append(const std::string& line);

  std::filesystem::path record_;
  CommissionedDevice device_;
  MeasuringPlan plan_;
  CommissioningResults results_;
};

/// The file that keeps what is measured of this device, unless another is given: in the folder
/// that the program runs in.
[[nodiscard]] std::filesystem::path usual_record(std::string_view device);

/// What a step found, a line each for people: "Gain", "0.902 [0.898, 0.906]", "N/N".
struct FoundLine {
  std::string what, value, unit;
};
[[nodiscard]] std::vector<FoundLine> found_in(CommissioningStep step,
                                              const CommissioningResults& results);

/// To three digits and without a power of ten: "2120", "83.5".
[[nodiscard]] std::string three_digits(double value);

}  // namespace jnd::app
