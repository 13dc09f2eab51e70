#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/commissioning/commissioning.h"
#include "app/operator/preflight.h"

namespace jnd::app {

/// A line of two columns in words, such as "Force at one point" and "10 N".
struct DeviceLine {
  std::string what, value;
};

/// What somebody at the device is asked to do.
struct DeviceQuestion {
  enum class Act { kTakeHandOut, kHome, kHold, kTouch, kLetGo, kHang, kTakeLoadOff };
  Act act = Act::kTakeHandOut;
  std::string words;
  double load_kg = 0.0;             ///< For `kHang`.
  Eigen::Vector3d mark_m{0, 0, 0};  ///< For `kTouch`, in the workspace.
  int num_touched = 0;              ///< How many marks of this step came before this one.
};

/// The work at the device; there is one at a time.
enum class DeviceWork {
  kNone,
  kLooking,
  kMeasuring,
  kChecking,
  kTryingForce,
  kWatching,
  kWriting
};

/// Everything that the window shows about a device, in words.
struct DeviceView {
  std::string name;       ///< The name as it is written after `--device`.
  bool is_known = false;  ///< The device was looked at and can be used.
  bool is_simulated = false;
  std::string problem;  ///< Why the device cannot be used, in a sentence; "" otherwise.
  std::vector<DeviceLine> facts;

  /// What a session would say about its profile now.
  PreflightLine profile;
  std::string profile_file;  ///< "" if no profile is found.
  std::vector<DeviceLine> profile_facts, profile_numbers;
  struct Check {
    std::string day, words;
    bool passed = false;
  };
  std::vector<Check> checks;  ///< The latest check comes first.

  struct Step {
    std::string title, to_do;
    std::string measured_at;  ///< "" if the step was not measured.
    std::vector<DeviceLine> found;
    bool waits = false;  ///< Another step has to be measured before this one.
  };
  std::array<Step, kCommissioningSteps.size()> steps;
  std::string record;          ///< The file of the measurements.
  std::string record_problem;  ///< Why the record cannot be continued; "" otherwise.
  std::vector<Eigen::Vector3d> marks_m, daily_marks_m;
  /// What to do for a daily check, in sentences.
  std::string daily_to_do;
  /// None if the profile can be written.
  std::optional<std::size_t> next_step;

  DeviceWork work = DeviceWork::kNone;
  std::size_t working_step = 0;
  double progress = 0.0;
  std::string now;  ///< What the device is doing; "" for nothing.
  std::optional<DeviceQuestion> question;
  bool stop_is_pressed = false;

  /// How the last work ended; "" if there is nothing to say.
  std::string outcome;
  DeviceWork outcome_of = DeviceWork::kNone;
  bool outcome_is_good = true;
  struct CheckedLine {
    std::string what, expected, found;
    bool passed = false;
  };
  std::vector<CheckedLine> checked;  ///< The lines of the last daily check.
  std::optional<bool> check_passed;
  /// What the device tells at this moment, while it is watched.
  std::vector<DeviceLine> live;
};

}  // namespace jnd::app
