#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/contact_sums.h"
#include "core/error.h"
#include "core/haptic_state.h"
#include "core/require.h"
#include "core/safety/fault.h"
#include "core/safety/workspace.h"

namespace jnd::device {

class Bench;
class SimulatedHand;

/// The device is not there, or not to be had now: nothing is wrong with what was asked for.
class DeviceUnreachable final : public core::Error {
 public:
  using core::Error::Error;
};

struct DeviceCapabilities {
  /// Of the hand's force at each point; 0 at one that the device does not have.
  core::ShareRatios share_ratio = core::kAreaShareRatio;
  [[nodiscard]] bool has_point(int i) const noexcept {
    return share_ratio[static_cast<std::size_t>(i)] > 0.0;
  }
  [[nodiscard]] int num_contact_points() const noexcept {
    int num_points = 0;
    for (int i = 0; i < core::kNumContactPoints; ++i) num_points += has_point(i) ? 1 : 0;
    return num_points;
  }
  double rate_hz = 1000.0;              ///< Of its control loop.
  double max_force_per_point_n = 10.0;  ///< What it can render at one point.
  double max_total_force_n = 30.0;      ///< Sum over the points.
  /// For how long its last measurement may stand in for one that did not come.
  double max_stale_s = 0.005;
  /// How long the loop may be silent before the watchdog takes the force away. Longer only
  /// where nobody can be hurt.
  double watchdog_timeout_s = 0.020;
  /// How long the window may be silent before the force fades. Longer only where nobody feels
  /// it.
  double heartbeat_timeout_s = 0.250;
  /// It lives at its own pace: a session on it runs in real time, also if it is simulated.
  bool has_own_clock = false;
  bool simulated = false;  ///< No person can be hurt by it.
  int num_joints = 0;      ///< It tells of: 0 or `core::kNumJoints`.
  /// Its measurements say which force acted until then, `HapticState::acted_n`: what was sent
  /// is late by the way there and may have been limited. A device that does not tell is taken
  /// to act at once, and only a simulated one is armed so.
  bool tells_acting_force = false;
  /// For how long a hand that a solid or a float pushes may read the very same position, to the
  /// last digit, before the loop takes the force away to see whether it moves: what its noise,
  /// its resolution and its friction make likely. Of no meaning for a simulation, which comes
  /// to rest exactly.
  double max_still_s = 2.0;
  bool moves_by_itself = false;                ///< By a simulated arm: nobody has to be there.
  double max_slew_n_per_s = core::kInfinity;   ///< Change of a point's force that it follows.
  double max_speed_m_per_s = core::kInfinity;  ///< Of a point, above which it is not sound.
  /// In which it may give force, within that of the loop.
  core::Workspace workspace{core::kInfinity, core::kInfinity, core::kInfinity};
  core::ChannelBits channels = 0;  ///< What it measures besides, `HapticState::channels`.
  bool takes_orders = true;        ///< Of one that moves by itself: it strokes as it is told.
  bool has_enable_switch = false;  ///< Of which `HapticState::enabled` tells.
  bool paces_loop = false;         ///< A tick is due when it has measured: `wait_for_sample`.
  double own_mass_kg = 0.0;        ///< That a hand feels in free space; 0: it does not say.
  double own_damping_n_s_per_m = 0.0;  ///< Likewise.
  double closed_loop_delay_s = 0.0;  ///< From a write until a read shows its effect, likewise.
};

/// Which one of its kind it is.
struct DeviceIdentity {
  std::string model;     ///< What it calls itself.
  std::string serial;    ///< "": it does not say.
  std::string firmware;  ///< Likewise.
};

/// How good the way to a device is that is elsewhere.
struct LinkReport {
  std::string_view level;  ///< "excellent", "good", "poor" or "unacceptable".
  bool may_arm = false;    ///< Good enough to bring the force back after a fault.
  bool may_give_force = false;
  double lost_ratio = 0.0;    ///< Of the device's datagrams, 0 to 1.
  double round_trip_s = 0.0;  ///< There and back, with the waiting for both sides' ticks.
};

/// A device that holds a hand at five points. Everything it takes and gives is in SI units and
/// in the workspace frame of `core::HapticState`; a device with another frame transforms
/// inside. Forces are those that act on the hand, not on the device.
///
/// Zero force is none on the hand, not none in the motors: a device that has weight of its own
/// holds it while forces fade, while it is halted and while it is faulted, and after `close`
/// its brakes do. A device that let go would fall on the hand.
///
/// Used by one thread at a time. A real device zeroes its force by itself when writes stop.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  /// As in the registry and on the command line. Real time.
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  [[nodiscard]] virtual DeviceCapabilities capabilities() const noexcept = 0;

  /// All of it is known once it is open. Not real time.
  [[nodiscard]] virtual DeviceIdentity identity() const {
    return {.model = std::string(name())};
  }

  /// Throws `core::Error`: the device cannot be used, and why. Motors may be on afterwards, so
  /// check for real time first (`require_realtime`). Not real time.
  virtual void open() = 0;

  /// The newest measurement. False: there was none; `state` is then undefined. Real time.
  [[nodiscard]] virtual bool read(core::HapticState& state) noexcept = 0;

  /// Of a device that paces the loop: until it has measured anew, or this monotonic time is
  /// over. False: it was over. Real time but for the waiting.
  [[nodiscard]] virtual bool wait_for_sample(std::int64_t /*deadline_ns*/) noexcept {
    return false;
  }

  /// Applies these forces until the next write; a simulated device moves on by its period.
  /// False: they were not taken. Real time.
  [[nodiscard]] virtual bool write(const core::PointVectors& force_on_hand_n) noexcept = 0;

  /// Zero force, motors off. May be called twice. Not real time.
  virtual void close() noexcept = 0;

  /// Why the last `read` or `write` returned false, where the device knows better than that it
  /// did. Real time.
  [[nodiscard]] virtual core::Fault fault() const noexcept { return core::Fault::kNone; }

  /// What the device's own program said of it, a part of a sentence; "": nothing. Of what was
  /// last wrong since it was opened. Any thread. Not real time.
  [[nodiscard]] virtual std::string words_of_fault() const { return ""; }

  /// Whether a person may bring the force back now, after a fault. False: not before whatever
  /// is wrong has mended; `fault` says what, or the connection. Real time.
  [[nodiscard]] virtual bool may_arm() const noexcept { return true; }

  /// Zero force at once and until a `write` of nothing but zeros: a loop that was held up in
  /// the middle of a tick must not bring an old force back. The watchdog's, which may call it
  /// from any thread, also while the loop's thread is stuck in the middle of the device; and
  /// the loop's, whose writes fail. A device that computes its forces in this program keeps a
  /// `HaltLatch`; one elsewhere passes it on. Real time.
  virtual void halt() noexcept = 0;

  /// The simulated person on it; nullptr: the hand is moved by somebody else.
  [[nodiscard]] virtual SimulatedHand* simulated_hand() noexcept { return nullptr; }

  /// Somebody simulated who does at it what measuring takes; nullptr: a person has to.
  [[nodiscard]] virtual Bench* bench() noexcept { return nullptr; }

  /// How good the way to it is; none: it is here. Not while another thread reads or writes.
  [[nodiscard]] virtual std::optional<LinkReport> link() const noexcept { return std::nullopt; }

  /// What the hand has been through, where the device knows it: a simulation. Real time.
  [[nodiscard]] virtual core::ContactSums contact_sums() const noexcept { return {}; }
};

}  // namespace jnd::device
