#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "chaos/schedule.h"
#include "core/hand.h"
#include "core/haptic_state.h"

namespace jnd::chaos {

/// Judges what a hand must never feel. The oracle sits in the device, behind everything else,
/// and knows what the schedule did, what the device said and what force arrived. It knows
/// nothing of the program, of its telemetry or of its faults. The times within which a force
/// has to be gone are those of SAFETY.md.
///
/// In each millisecond, call `begin_millisecond` first and then report what happens, in its
/// order.
class Oracle {
 public:
  explicit Oracle(const Schedule& schedule);

  // Acts of people.
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

  // Acts of the device.
  void handed_out(const core::HapticState& state);
  void could_not_be_read();
  /// A write came, and the hand has been under `standing_n` since.
  void written(const core::PointVectors& standing_n, bool was_taken);
  /// Something other than a write took the force away.
  void zeroed() { standing_n_ = core::zero_vectors(); }
  /// These forces acted for a millisecond while the hand went this way.
  void moved(const core::PointVectors& acted_n, const Eigen::Vector3d& way_m);

  /// Judges the last millisecond and begins another.
  void begin_millisecond(int now_ms);

  /// The first thing that was wrong; "" if nothing was.
  [[nodiscard]] const std::string& violation() const noexcept { return violation_; }
  /// Tells whether a schedule led to any force at all.
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

  /// How a cause reaches the force, which decides how long that may take.
  enum class Way {
    kDevice,  ///< The side that reads and writes the device sees the cause, in the same tick.
    kLoop,    ///< Only the loop sees the cause; a network may be in between.
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

/// The most energy that a hand may be given beyond what it put in, within the quarter of a
/// second that the watch over the port remembers. It is 0.25 J where reading and force are
/// prompt (the largest of 6000 schedules was 0.19 J, with 30 g). Where they are late, or a
/// force stands until a watchdog ends it, the force pushes until a reading shows it. Then m v =
/// F t, so (20 N t)^2 / 2 m is added. The limiter would allow 30 N; the energies that were
/// found are those of 14 N, so that the bound is twice what was found.
[[nodiscard]] double most_energy_j(const Schedule& schedule);

}  // namespace jnd::chaos
