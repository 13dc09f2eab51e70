#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "chaos/schedule.h"
#include "core/hand.h"
#include "core/haptic_state.h"

namespace jnd::chaos {

/// Judges what a hand must never feel. It sits in the device, behind everything else. It knows
/// what the schedule did, what the device measured and what force arrived, and nothing of the
/// program, its telemetry or its faults. The times within which a force must be gone are those
/// of SAFETY.md.
///
/// In each millisecond, call `begin_millisecond` first, and then the other functions in the
/// order of events.
class Oracle {
 public:
  explicit Oracle(const Schedule& schedule);

  // These functions report what people did.
  void armed();
  void disarmed();
  void stop_pressed();
  void stop_released() { stop_is_pressed_ = false; }
  void medium_sent(bool is_broken);

  // These functions report what the schedule allowed to happen.
  void window_beat() { num_silent_ticks_ = 0; }
  void loop_ticked();
  void program_started();
  void server_restarted();

  // These functions report what the device did.
  void handed_out(const core::HapticState& state);
  void could_not_be_read();
  /// Reports a write. `standing_n` is the force that the hand is under from then on.
  void written(const core::PointVectors& standing_n, bool was_taken);
  /// Reports that something other than a write took the force away.
  void zeroed() { standing_n_ = core::zero_vectors(); }
  /// Reports the forces that acted for a millisecond while the hand moved by `way_m`.
  void moved(const core::PointVectors& acted_n, const Eigen::Vector3d& way_m);

  /// Judges the millisecond that is over and begins the next one.
  void begin_millisecond(int now_ms);

  /// Returns the first violation, or "" if there was none.
  [[nodiscard]] const std::string& violation() const noexcept { return violation_; }
  /// Returns for how many milliseconds there was force, which shows whether a schedule tested
  /// anything.
  [[nodiscard]] int num_milliseconds_with_force() const noexcept { return num_with_force_; }
  [[nodiscard]] double most_given_j() const noexcept { return most_given_j_; }

 private:
  /// A reason for which there must be no force, and the time at which it must be gone.
  struct Revocation {
    std::string cause;
    int deadline_ms;
    bool ends_with_next_write;
  };

  /// How a cause reaches the force, which decides how long it may take.
  enum class Way {
    kDevice,  ///< The part that reads and writes the device sees it in the same tick.
    kLoop,    ///< Only the loop sees it, and a network may lie between.
  };

  [[nodiscard]] bool is_networked() const { return schedule_.world == World::kNetwork; }
  void revoke(const std::string& cause, Way way);
  void revoke_at_once(const std::string& cause);
  void judge_staleness(const core::HapticState& state);
  void judge_leaps(const core::HapticState& state);
  void judge_speeds(const core::HapticState& state);
  void judge_silences();
  void judge_force();
  void judge_write(const core::PointVectors& standing_n);
  void violated(const std::string& what);

  const Schedule& schedule_;
  int now_ms_ = 0;
  std::string violation_;

  bool may_have_force_ = false;
  std::string why_not_ = "nobody has armed the device";
  bool stop_is_pressed_ = false;
  bool medium_is_broken_ = false;
  std::vector<Revocation> revocations_;

  int num_silent_ticks_ = 0;
  int dead_ms_ = 0;  ///< The time since the loop's last tick.
  int cut_ms_ = 0;   ///< The time since the cable was pulled.
  bool was_written_ = false;

  std::optional<core::HapticState> last_reading_;
  std::array<bool, core::kNumContactPoints> attached_ = core::kAllAttached;
  int num_stale_readings_ = 0;
  int num_stuck_readings_ = 0;
  std::array<double, core::kNumContactPoints> stuck_way_m_{};
  core::PointVectors standing_n_ = core::zero_vectors();
  double given_j_ = 0.0;
  double most_given_j_ = 0.0;
  int num_with_force_ = 0;
};

/// Returns the largest energy that a hand may be given beyond what it put in, within the
/// quarter of a second that the watch over the port remembers. It is 0.25 J if reading and
/// force are prompt. (The largest of 6000 schedules was 0.19 J, with a mass of 30 g.) If they
/// are late, or a force stands until a watchdog ends it, the force pushes until a reading shows
/// it. Then m v = F t, so (20 N t)^2 / 2 m is added. The limiter would allow 30 N, and the
/// measured energies correspond to 14 N, so the bound is twice what was measured.
[[nodiscard]] double most_energy_j(const Schedule& schedule);

}  // namespace jnd::chaos
