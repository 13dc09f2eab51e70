#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "chaos/schedule.h"
#include "core/hand.h"
#include "core/haptic_state.h"

namespace jnd::chaos {

/// What a hand must never feel. It sits in the device, behind everything else, and knows what
/// the schedule did, what the device said and what force arrived: nothing of the program, of
/// its telemetry or of its faults. The times in which a force has to be gone are those of
/// SAFETY.md.
///
/// In each millisecond: `begin_millisecond`, then whatever happens, in its order.
class Oracle {
 public:
  explicit Oracle(const Schedule& schedule);

  // What people did.
  void armed();
  void disarmed();
  void stop_pressed();
  void stop_released();
  void medium_sent(bool is_broken);

  // What the schedule let happen.
  void window_beat();
  void loop_ticked();
  void program_started();
  void server_restarted();

  // What the device did.
  void handed_out(const core::HapticState& state);
  void could_not_be_read();
  /// A write came. What the hand is under since: `standing_n`.
  void written(const core::PointVectors& standing_n, bool was_taken);
  /// Something else than a write took the force away.
  void zeroed() { standing_n_ = core::zero_vectors(); }
  /// The forces that acted for a millisecond while the hand went this way.
  void moved(const core::PointVectors& acted_n, const Eigen::Vector3d& way_m);

  /// Judges the millisecond before and begins another.
  void begin_millisecond(int now_ms);

  /// The first thing that was wrong; empty: nothing was.
  [[nodiscard]] const std::string& violation() const noexcept { return violation_; }
  /// For whoever wants to know whether a schedule came to anything.
  [[nodiscard]] int num_milliseconds_with_force() const noexcept { return num_with_force_; }
  [[nodiscard]] double most_given_j() const noexcept { return most_given_j_; }

 private:
  static constexpr int kArmAfterRelease_ms = 500;

  /// A reason for which there must be no force, and when it has to be gone.
  struct Revocation {
    std::string cause;
    int deadline_ms;
    bool ends_with_next_write;
  };

  /// Within how much time a cause has to reach the force.
  enum class Way {
    kDevice,  ///< Whoever reads and writes the device sees it: in the same tick.
    kLoop,    ///< Only the loop sees it: a network may be in between.
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
  int released_ms_ = -kArmAfterRelease_ms;
  bool medium_is_broken_ = false;
  std::vector<Revocation> revocations_;

  int last_beat_ms_ = 0;
  int last_tick_ms_ = 0;
  int silent_ms_ = 0;       ///< Without a beat, when the loop ticked last.
  int longest_gap_ms_ = 0;  ///< Between the loop's ticks since that beat.
  int dead_ms_ = 0;         ///< Since the loop's last tick.
  int cut_ms_ = 0;          ///< Since the cable was pulled.
  bool was_written_ = false;

  std::optional<core::HapticState> last_reading_;
  std::array<bool, core::kNumContactPoints> attached_ = core::kAllAttached;
  int last_new_ms_ = 0;  ///< When a reading was new.
  int num_stuck_readings_ = 0;
  std::array<double, core::kNumContactPoints> stuck_way_m_{};
  core::PointVectors standing_n_ = core::zero_vectors();
  double given_j_ = 0.0;
  double most_given_j_ = 0.0;
  int num_with_force_ = 0;
};

/// The most that a hand may be given beyond what it put in, within the quarter of a second that
/// the watch over the port remembers: 0.25 J where reading and force are prompt (the largest of
/// 6000 schedules was 0.19 J, of 30 g). Where they are late, or a force stands until a
/// watchdog ends it, it pushes until a reading shows it, and m v = F t: (20 N t)^2 / 2 m comes
/// on top. The limiter would allow 30 N; the energies that were found are those of 14 N, so
/// that the bound is twice what was found.
[[nodiscard]] double most_energy_j(const Schedule& schedule);

}  // namespace jnd::chaos
