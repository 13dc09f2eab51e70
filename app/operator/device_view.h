#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/commissioning/commissioning.h"
#include "app/operator/preflight.h"

namespace jnd::app {

/// A line of two columns, in words: "Force at one point", "10 N".
struct DeviceLine {
  std::string what, value;
};

/// What somebody at the device is asked to do.
struct DeviceQuestion {
  enum class Act { kTakeHandOut, kHome, kHold, kTouch, kLetGo, kHang, kTakeLoadOff };
  Act act = Act::kTakeHandOut;
  std::string words;
  double load_kg = 0.0;             ///< Of `kHang`.
  Eigen::Vector3d mark_m{0, 0, 0};  ///< Of `kTouch`, in the workspace.
  int num_touched = 0;              ///< Marks before this one in this step.
};

/// What goes on at the device, one thing at a time.
enum class DeviceWork {
  kNone,
  kLooking,
  kMeasuring,
  kChecking,
  kTryingForce,
  kWatching,
  kWriting
};

/// All that the window shows of a device, in words.
struct DeviceView {
  std::string name;       ///< As after `--device`.
  bool is_known = false;  ///< It was looked at, and can be used.
  bool is_simulated = false;
  std::string problem;  ///< Why it cannot, a sentence; "".
  std::vector<DeviceLine> facts;

  /// What a session would say of its profile now.
  PreflightLine profile;
  std::string profile_file;  ///< "": none is found.
  std::vector<DeviceLine> profile_facts, profile_numbers;
  struct Check {
    std::string day, words;
    bool passed = false;
  };
  std::vector<Check> checks;  ///< The last one first.

  struct Step {
    std::string title, to_do;
    std::string measured_at;  ///< "": it is not measured.
    std::vector<DeviceLine> found;
    bool waits = false;  ///< For another step, which has to be measured before.
  };
  std::array<Step, kCommissioningSteps.size()> steps;
  std::string record;          ///< File of the measurements.
  std::string record_problem;  ///< Why it cannot be gone on with; "".
  std::vector<Eigen::Vector3d> marks_m, daily_marks_m;
  std::string daily_to_do;               ///< For a daily check; sentences.
  std::optional<std::size_t> next_step;  ///< None: the profile can be written.

  DeviceWork work = DeviceWork::kNone;
  std::size_t working_step = 0;
  double progress = 0.0;
  std::string now;  ///< What the device does; "".
  std::optional<DeviceQuestion> question;
  bool stop_is_pressed = false;

  /// Of the last work that ended; "": there is nothing to say.
  std::string outcome;
  DeviceWork outcome_of = DeviceWork::kNone;
  bool outcome_is_good = true;
  struct CheckedLine {
    std::string what, expected, found;
    bool passed = false;
  };
  std::vector<CheckedLine> checked;  ///< Of the last daily check.
  std::optional<bool> check_passed;
  /// What the device tells at this moment, while it is watched.
  std::vector<DeviceLine> live;
};

}  // namespace jnd::app
