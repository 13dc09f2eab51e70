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

/// One thing that is looked at before a session, with what mends it.
struct PreflightLine {
  enum class Status {
    kWaiting,  ///< Not looked at yet.
    kOk,
    kWarning,  ///< A session can begin all the same.
    kFailed,   ///< None should.
  };
  std::string name;  ///< "Loop"
  Status status = Status::kWaiting;
  std::string found;   ///< One short phrase: "none missed, 99 % within 0.03 ms".
  std::string remedy;  ///< What to do; "" where nothing needs to be done.
};

struct PreflightRequest {
  std::filesystem::path folder;  ///< The study's; nothing may have it open for writing.
  std::string device = "lumped";
  std::string profile;  ///< Of the device, a file; "": a real one's own is looked for.
  bool allow_no_realtime = false;  ///< A real device also without real-time rights.
  double loop_test_s = 2.0;
  /// That reaches the device in the loop's test; nullptr: none but the program's end.
  core::EmergencyStop* emergency_stop = nullptr;
};

/// Looks at everything in turn: study file, folder, disk, real-time priority, memory lock,
/// device, stimuli, loop. `on_lines` is called with all lines whenever one of them is known; it
/// may be empty. Throws `WorkCancelled` alone: what goes wrong is a line. Not real time.
[[nodiscard]] std::vector<PreflightLine> look_before_session(
    const PreflightRequest& request, WorkControl& control,
    const std::function<void(const std::vector<PreflightLine>&)>& on_lines);

/// The same beside the window, line by line.
class Preflight {
 public:
  explicit Preflight(PreflightRequest request, std::function<void()> wake = {});

  [[nodiscard]] std::vector<PreflightLine> lines() const;
  [[nodiscard]] bool running() const noexcept { return work_.running(); }
  [[nodiscard]] double progress() const noexcept { return work_.progress(); }
  /// Everything was looked at, and nothing failed.
  [[nodiscard]] bool passed() const;
  void cancel() noexcept { work_.cancel(); }
  /// Takes the force from the device in the loop's test, which fails then. Any thread.
  void press_emergency_stop() noexcept { emergency_stop_.press(); }
  void wait() { work_.wait(); }

 private:
  mutable std::mutex mutex_;
  std::vector<PreflightLine> lines_;
  core::EmergencyStop emergency_stop_;
  BackgroundWork work_;
};

/// What the start view tells of the machine: priority, memory lock, disk, devices. Quick.
[[nodiscard]] std::vector<PreflightLine> look_at_machine();

/// What `work` finds; where it throws `core::Error`, a failed line with its sentence.
[[nodiscard]] PreflightLine line_from(const std::string& name, const std::string& failure,
                                      const std::function<PreflightLine()>& work);

// The single lines. Each is quick but the loop's.

[[nodiscard]] PreflightLine study_file_line(const std::filesystem::path& folder);
[[nodiscard]] PreflightLine folder_line(const std::filesystem::path& folder);
/// `session_s`: expected length of a session; its samples are counted with what a recording
/// takes at most.
[[nodiscard]] PreflightLine disk_line(double free_bytes, double rate_hz, double session_s);
[[nodiscard]] PreflightLine device_line(const std::string& device, double rate_hz,
                                        int min_contact_points);
/// The same with what was measured of the device, `known`; `refused`: why no session of this
/// study is begun on it, "" if one may.
[[nodiscard]] PreflightLine with_profile(PreflightLine line,
                                         const std::optional<KnownProfile>& known,
                                         const std::string& refused);
/// Where `hides_levels`, the number of stimuli that fit alone. `stability`: of a device that
/// has a map of it; an unstable stimulus fails.
[[nodiscard]] PreflightLine stimuli_line(const std::vector<experiments::RangeEntry>& range,
                                         const experiments::RangeLimits& limits,
                                         bool hides_levels,
                                         const std::optional<StabilityCheck>& stability = {});

/// What the loop did in its test.
struct LoopTest {
  double rate_hz = 0.0, duration_s = 0.0;
  double lateness_p99_us = 0.0;
  std::int64_t missed_ticks = 0;
  bool for_a_person = false;                 ///< The device can hurt somebody.
  std::optional<device::LinkReport> link{};  ///< To a device that is elsewhere.
  std::string fault;                         ///< In words; "" for none.
};
[[nodiscard]] PreflightLine loop_line(const LoopTest& test);
/// Runs the loop with the device in free space, which is no force. `on_progress` is called with
/// 0 to 1 from the calling thread and may throw to stop. Throws `core::Error` if it does not
/// start.
[[nodiscard]] LoopTest test_loop(const PreflightRequest& request, double rate_hz,
                                 const std::optional<KnownProfile>& known,
                                 const std::function<void(double)>& on_progress = {});

}  // namespace jnd::app
