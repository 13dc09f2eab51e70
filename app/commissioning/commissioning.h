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

/// What a step is called, and what somebody has to do for it.
struct StepWords {
  std::string_view name;  ///< The name in options and records, such as "force".
  const char* title;      ///< The title, such as "Force, weight and friction".
  /// What the person at the device has to do, in sentences.
  const char* to_do;
};
[[nodiscard]] const StepWords& words_of(CommissioningStep step) noexcept;
/// The step of this name; none if there is no such step.
[[nodiscard]] std::optional<CommissioningStep> step_named(std::string_view name) noexcept;
/// The steps that have to be measured before this one, because it uses their results.
[[nodiscard]] std::vector<CommissioningStep> steps_before(CommissioningStep step);

/// Which device it is, as the device says when it is open.
struct CommissionedDevice {
  std::string name;  ///< The name as it is written after `--device`.
  device::DeviceIdentity identity;
  device::DeviceCapabilities can;
};

/// What was measured so far, with the newest measurement of each step.
struct CommissioningResults {
  std::optional<analysis::HomingFit> homing;
  std::optional<analysis::NoiseFit> noise;
  std::optional<analysis::FrameFit> frame;
  std::optional<analysis::DelayFit> delay;
  std::optional<analysis::ForceFit> force;
  std::optional<analysis::StabilityFit> stability;
  /// When each step was measured, such as "2026-11-25T10:12:00Z"; "" if it was not.
  std::array<std::string, kCommissioningSteps.size()> measured_at;

  /// The conditions under which each step was measured; none if the record does not say them.
  std::array<std::optional<MeasuringConditions>, kCommissioningSteps.size()> conditions;

  [[nodiscard]] bool has(CommissioningStep step) const noexcept {
    return !measured_at[static_cast<std::size_t>(step)].empty();
  }
};

/// A device that is being commissioned, step by step, with a record of everything that was
/// measured. The record is a file with one JSON document on each line, to which lines are only
/// added. Each line is on disk before the next step begins, so an interruption at any step
/// loses nothing that was measured, and the same file can be continued. Not real time; used by
/// one thread.
class Commissioning {
 public:
  /// Begins a record, or continues it. Throws `core::Error` if the record is damaged or belongs
  /// to another device.
  Commissioning(std::filesystem::path record, CommissionedDevice device, MeasuringPlan plan);

  /// Measures this step again and stores it. Measurements that used an earlier measurement of
  /// this step no longer count. Throws `core::Error` if a step before it is missing, and
  /// whatever the measurement throws; then only the failure and its reason are stored.
  void measure(CommissioningStep step, device::HapticDevice& device, device::Bench& bench,
               const StepProgress& progress);
  /// Makes the step count as not measured, and the steps that use it as well.
  void undo(CommissioningStep step);

  [[nodiscard]] const CommissioningResults& results() const noexcept { return results_; }
  [[nodiscard]] const CommissionedDevice& device() const noexcept { return device_; }
  [[nodiscard]] const MeasuringPlan& plan() const noexcept { return plan_; }
  [[nodiscard]] const std::filesystem::path& record() const noexcept { return record_; }
  /// The first step that is not measured; none if the commissioning is complete.
  [[nodiscard]] std::optional<CommissioningStep> next_step() const noexcept;

 private:
  void read_record();
  void append(const std::string& line);

  std::filesystem::path record_;
  CommissionedDevice device_;
  MeasuringPlan plan_;
  CommissioningResults results_;
};

/// The file for what is measured of this device unless another one is given; it is in the
/// folder in which the program runs.
[[nodiscard]] std::filesystem::path usual_record(std::string_view device);

/// What a step found, one line each for people: "Gain", "0.902 [0.898, 0.906]", "N/N".
struct FoundLine {
  std::string what, value, unit;
};
[[nodiscard]] std::vector<FoundLine> found_in(CommissioningStep step,
                                              const CommissioningResults& results);

/// A number to three digits and without a power of ten, such as "2120" or "83.5".
[[nodiscard]] std::string three_digits(double value);

}  // namespace jnd::app
