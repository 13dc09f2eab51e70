#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/background_task.h"
#include "app/profile/known_profile.h"
#include "app/session/stability_limits.h"
#include "core/safety/emergency_stop.h"
#include "device/haptic_device.h"
#include "experiments/session/plan.h"

namespace jnd::app {

/// One thing that is checked before a session, and how to remedy it.
struct PreflightLine {
  enum class Status {
    kWaiting,  ///< It was not checked yet.
    kOk,
    kWarning,  ///< A session can begin in spite of it.
    kFailed,   ///< No session should begin.
  };
  std::string name;  ///< The name, such as "Loop".
  Status status = Status::kWaiting;
  /// One short phrase, such as "none missed, 99 % within 0.03 ms".
  std::string found;
  std::string remedy;  ///< What to do; "" if nothing needs to be done.
};

struct PreflightRequest {
  /// The study's folder; no other program may have it open for writing.
  std::filesystem::path folder;
  std::string device = "lumped";
  /// The file of the device's profile; if "", a real device's own profile is looked for.
  std::string profile;
  /// A real device may run without real-time rights.
  bool allow_no_realtime = false;
  double loop_test_s = 2.0;
  /// The stop that ends the force in the loop's test; with nullptr, only the program's end
  /// does.
  core::EmergencyStop* emergency_stop = nullptr;
};

/// Checks everything in turn: study file, folder, disk, real-time priority, memory lock, sleep,
/// device, stimuli, loop. `on_lines`, unless it is empty, is called with all lines whenever one
/// of them is known. Throws nothing but `WorkCancelled`; problems become lines. Not real time.
[[nodiscard]] std::vector<PreflightLine> look_before_session(
    const PreflightRequest& request, WorkControl& control,
    const std::function<void(const std::vector<PreflightLine>&)>& on_lines);

/// Runs the same check in the background, line by line.
class Preflight {
 public:
  explicit Preflight(PreflightRequest request, std::function<void()> wake = {});

  [[nodiscard]] std::vector<PreflightLine> lines() const;
  [[nodiscard]] bool running() const noexcept { return work_.running(); }
  [[nodiscard]] double progress() const noexcept { return work_.progress(); }
  /// True if everything was checked, and nothing failed.
  [[nodiscard]] bool passed() const;
  void cancel() noexcept { work_.cancel(); }
  /// Takes the force from the device in the loop's test, which then fails. May be called from
  /// any thread.
  void press_emergency_stop() noexcept { emergency_stop_.press(); }
  void wait() { work_.wait(); }

 private:
  mutable std::mutex mutex_;
  std::vector<PreflightLine> lines_;
  core::EmergencyStop emergency_stop_;
  BackgroundWork work_;
};

/// What the start view tells about the machine: priority, memory lock, disk, devices. It is
/// quick.
[[nodiscard]] std::vector<PreflightLine> look_at_machine();

/// The line that `work` returns; if it throws `core::Error`, a failed line with its sentence.
[[nodiscard]] PreflightLine line_from(const std::string& name, const std::string& failure,
                                      const std::function<PreflightLine()>& work);

// The single lines. Each is quick, except the loop's.

[[nodiscard]] PreflightLine study_file_line(const std::filesystem::path& folder);
[[nodiscard]] PreflightLine folder_line(const std::filesystem::path& folder);
/// `session_s` is the expected length of a session. Each of its samples is counted with the
/// most that a recording takes for one.
[[nodiscard]] PreflightLine disk_line(double free_bytes, double rate_hz, double session_s);
[[nodiscard]] PreflightLine device_line(const std::string& device, double rate_hz,
                                        int min_contact_points);
/// Adds what was measured of the device (`known`) to its line. `refused` says why no session of
/// this study may begin on it, or is "".
[[nodiscard]] PreflightLine with_profile(PreflightLine line,
                                         const std::optional<KnownProfile>& known,
                                         const std::string& refused);
/// If `hides_levels`, tells only how many stimuli fit. `stability` is for a device that has a
/// stability map; an unstable stimulus fails.
[[nodiscard]] PreflightLine stimuli_line(const std::vector<experiments::RangeEntry>& range,
                                         const experiments::RangeLimits& limits,
                                         bool hides_levels,
                                         const std::optional<StabilityCheck>& stability = {});

/// How the loop did in its test.
struct LoopTest {
  double rate_hz = 0.0, duration_s = 0.0;
  double lateness_p99_us = 0.0;
  std::int64_t missed_ticks = 0;
  /// The device is real, so it can hurt somebody.
  bool for_a_person = false;
  /// The link to a device that is elsewhere.
  std::optional<device::LinkReport> link{};
  std::string fault;  ///< The fault in words; "" for none.
};
[[nodiscard]] PreflightLine loop_line(const LoopTest& test);
/// Runs the loop with the device in free space, where there is no force. The calling thread
/// calls `on_progress` with 0 to 1; it may throw to stop the test. Throws `core::Error` if the
/// loop does not start.
[[nodiscard]] LoopTest test_loop(const PreflightRequest& request, double rate_hz,
                                 const std::optional<KnownProfile>& known,
                                 const std::function<void(double)>& on_progress = {});

}  // namespace jnd::app
