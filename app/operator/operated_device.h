#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/operator/background_task.h"
#include "app/operator/device_view.h"
#include "core/safety/emergency_stop.h"
#include "core/safety/heartbeat.h"
#include "device/bench.h"

namespace jnd::app {

/// A device that somebody at a window looks at, measures, checks and tries: one thing at a
/// time, on a thread of its own. Whatever has to be done at the device is asked for, and the
/// work waits for an answer. The window's thread calls everything, except the stop and the sign
/// of life, which any thread may give.
class OperatedDevice {
 public:
  /// `wake`: draws a frame; called from any thread.
  /// `stops`: where stops are remembered that nobody released; "": nowhere. See
  /// `remember_stop`.
  explicit OperatedDevice(std::function<void()> wake, bool allow_no_realtime = false,
                          std::filesystem::path stops = {});
  /// Takes the force from the device and waits until it is let go.
  ~OperatedDevice();
  OperatedDevice(const OperatedDevice&) = delete;
  OperatedDevice& operator=(const OperatedDevice&) = delete;

  /// Looks at this device. `profile` is its profile's file; if "", its own profile is looked
  /// for.
  void choose(const std::string& device, const std::string& profile);
  void look_again() { choose(device_, profile_); }
  /// Sets whether a simulated device asks as a real one would, so that people can rehearse.
  void set_rehearsing(bool rehearses) noexcept { rehearses_ = rehearses; }

  // These do nothing while other work goes on, or while the stop is pressed.
  void measure(CommissioningStep step);
  void undo(CommissioningStep step);
  void write_profile();
  void check_daily();
  /// Tries half a newton along this axis of the workspace, 0 to 2.
  void try_force(int axis);
  /// Shows what the device tells until `leave_off`. It has no force meanwhile.
  void watch();

  /// Tells that what was asked for is done.
  void answer();
  /// Ends the work and keeps what was measured.
  void leave_off();
  /// May be called from any thread.
  void press_stop() noexcept;
  void release_stop() noexcept;
  /// The window is alive, and its stop in sight. Without that the force of a real device fades.
  /// Any thread.
  void beat(bool is_in_sight = true) noexcept {
    if (is_in_sight) watcher_.beat();
  }

  /// True while a device may move, or waits for an answer.
  [[nodiscard]] bool is_live() const noexcept;
  [[nodiscard]] bool works() const noexcept { return work_ && work_->running(); }
  [[nodiscard]] const std::string& device() const noexcept { return device_; }
  [[nodiscard]] DeviceView view();

 private:
  class WindowBench;

  [[nodiscard]] bool may_begin() const noexcept;
  void begin(DeviceWork kind, const std::function<std::string()>& work);
  void measure_at(const std::function<void(device::HapticDevice&, device::Bench&)>& act);
  void ask(DeviceQuestion question);
  void tell(double done, const std::string& now);
  [[nodiscard]] MeasuringPlan plan() noexcept;

  std::function<void()> wake_;
  bool allow_no_realtime_;
  std::filesystem::path stops_;
  bool rehearses_ = false;
  std::string device_, profile_;
  core::EmergencyStop emergency_stop_;
  core::Heartbeat watcher_;

  mutable std::mutex mutex_;
  std::condition_variable answered_;
  DeviceView view_;  ///< As the last look and the work under way have set it.
  bool has_answer_ = false;
  bool leaves_off_ = false;
  /// The press of the stop that only ended a step; 0 for none.
  std::uint64_t own_press_ = 0;

  std::unique_ptr<BackgroundWork> work_;
};

}  // namespace jnd::app
