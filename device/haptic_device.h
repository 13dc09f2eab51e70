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

/// The device is missing or not available now. The request itself was correct.
class DeviceUnreachable final : public core::Error {
 public:
  using core::Error::Error;
};

struct DeviceCapabilities {
  /// Share of the hand's force at each point; 0 at a point that the device does not have.
  core::ShareRatios share_ratio = core::kAreaShareRatio;
  [[nodiscard]] bool has_point(int i) const noexcept {
    return share_ratio[static_cast<std::size_t>(i)] > 0.0;
  }
  [[nodiscard]] int num_contact_points() const noexcept {
    int num_points = 0;
    for (int i = 0; i < core::kNumContactPoints; ++i) num_points += has_point(i) ? 1 : 0;
    return num_points;
  }
  double rate_hz = 1000.0;              ///< Rate of its control loop.
  double max_force_per_point_n = 10.0;  ///< Largest force that it can render at one point.
  double max_total_force_n = 30.0;      ///< Limit of the sum over the points.
  /// How long its last measurement may be reused for a missing one.
  double max_stale_s = 0.005;
  /// How long the loop may be silent before the watchdog takes the force away. Longer only if
  /// nobody can be hurt.
  double watchdog_timeout_s = 0.020;
  /// How long the window may be silent before the force fades. Longer only if nobody feels the
  /// force.
  double heartbeat_timeout_s = 0.250;
  /// The device runs at its own pace. A session on it runs in real time, even if the device is
  /// simulated.
  bool has_own_clock = false;
  bool simulated = false;  ///< It cannot hurt anybody.
  /// Its driver or server says that it cannot hurt anybody, even if the operator opens it as a
  /// real one and `simulated` is false.
  bool says_simulated = false;
  int num_joints = 0;  ///< Number of joints that it reports: 0 or `core::kNumJoints`.
  /// Its measurements say which force has acted, in `HapticState::acted_n`. A sent force acts
  /// late, and the device may limit it. A device that does not report this is assumed to act at
  /// once, and is armed only if it is simulated.
  bool tells_acting_force = false;
  /// How long a hand that a solid or buoyancy pushes may read exactly the same position before
  /// the loop takes the force away to see whether the hand moves. It depends on the device's
  /// noise, resolution and friction. It has no meaning for a simulation, which comes to rest
  /// exactly.
  double max_still_s = 2.0;
  /// A simulated arm moves it, so nobody has to be there.
  bool moves_by_itself = false;
  /// Largest change of a point's force that it can follow.
  double max_slew_n_per_s = core::kInfinity;
  double max_speed_m_per_s = core::kInfinity;  ///< Largest valid speed of a point.
  /// Space in which it may give force, within that of the loop.
  core::Workspace workspace{core::kInfinity, core::kInfinity, core::kInfinity};
  core::ChannelBits channels = 0;  ///< What it measures besides, in `HapticState::channels`.
  /// For a device that moves by itself: it strokes as ordered.
  bool takes_orders = true;
  bool has_enable_switch = false;  ///< `HapticState::enabled` reports this switch.
  /// A tick is due when it has measured; see `wait_for_sample`.
  bool paces_loop = false;
  double own_mass_kg = 0.0;  ///< Mass that a hand feels in free space; 0 if unknown.
  /// Damping that a hand feels in free space; 0 if unknown.
  double own_damping_n_s_per_m = 0.0;
  /// Time from a write until a read shows its effect; 0 if unknown.
  double closed_loop_delay_s = 0.0;
};

/// Identifies a device among those of its kind.
struct DeviceIdentity {
  std::string model;     ///< The name that the device reports.
  std::string serial;    ///< "" if it does not report one.
  std::string firmware;  ///< "" if it does not report one.
};

/// Quality of the connection to a remote device.
struct LinkReport {
  std::string_view level;  ///< "excellent", "good", "poor" or "unacceptable".
  /// Whether the connection is good enough to bring the force back after a fault.
  bool may_arm = false;
  bool may_give_force = false;
  double lost_ratio = 0.0;    ///< Share of the device's datagrams that were lost, 0 to 1.
  double round_trip_s = 0.0;  ///< Includes the waiting for the ticks of both sides.
};

/// A device that holds a hand at five points. All values are in SI units and in the workspace
/// frame of `core::HapticState`; a device with another frame transforms inside. Forces are
/// those that act on the hand, not on the device.
///
/// Zero force means no force on the hand, not no torque in the motors. A device with a weight
/// of its own holds it while forces fade, while it is halted and while it has a fault. After
/// `close` its brakes hold it. A device that let go would fall on the hand.
///
/// One thread at a time may use it. A real device sets its force to zero by itself if writes
/// stop.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  /// Returns the name in the registry and on the command line. Real time.
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  [[nodiscard]] virtual DeviceCapabilities capabilities() const noexcept = 0;

  /// Returns what is known of the device; everything is known once it is open. Not real time.
  [[nodiscard]] virtual DeviceIdentity identity() const {
    return {.model = std::string(name())};
  }

  /// Opens the device. Throws `core::Error` that says why the device cannot be used. Its motors
  /// may be on afterwards, so call `require_realtime` first. Not real time.
  virtual void open() = 0;

  /// Reads the newest measurement. Returns false if there was none; `state` is then undefined.
  /// Real time.
  [[nodiscard]] virtual bool read(core::HapticState& state) noexcept = 0;

  /// For a device that paces the loop: waits until it has a new measurement, or until this
  /// monotonic time. Returns false in the second case. Real time apart from the waiting.
  [[nodiscard]] virtual bool wait_for_sample(std::int64_t /*deadline_ns*/) noexcept {
    return false;
  }

  /// Applies these forces until the next write. A simulated device also advances by its period.
  /// Returns false if it did not accept the forces. Real time.
  [[nodiscard]] virtual bool write(const core::PointVectors& force_on_hand_n) noexcept = 0;

  /// Sets zero force and switches the motors off. It may be called twice. Not real time.
  virtual void close() noexcept = 0;

  /// Returns why the last `read` or `write` returned false, if the device knows. Real time.
  [[nodiscard]] virtual core::Fault fault() const noexcept { return core::Fault::kNone; }

  /// Returns what the device's own program reported about the last problem since the device was
  /// opened, as part of a sentence, or "". Any thread. Not real time.
  [[nodiscard]] virtual std::string words_of_fault() const { return ""; }

  /// Whether the device's own program still runs and answers. If not, `words_of_fault` says so.
  /// Any thread. Not real time.
  [[nodiscard]] virtual bool answers() const { return true; }

  /// Whether a person may bring the force back now, after a fault. It is false until the cause
  /// is gone, which `fault` or the connection tells. Real time.
  [[nodiscard]] virtual bool may_arm() const noexcept { return true; }

  /// Sets zero force at once, until a `write` consists of zeros only, because a loop that was
  /// held up in the middle of a tick must not bring an old force back. The watchdog calls it
  /// from any thread, even while the loop's thread is stuck inside of the device. The loop
  /// calls it if its writes fail. A device that computes its forces in this program uses a
  /// `HaltLatch`; a remote one passes the halt on. Real time.
  virtual void halt() noexcept = 0;

  /// Returns the simulated person at the device, or nullptr if somebody else moves the hand.
  [[nodiscard]] virtual SimulatedHand* simulated_hand() noexcept { return nullptr; }

  /// Returns a simulated person who does what a measurement requires, or nullptr if a real
  /// person has to.
  [[nodiscard]] virtual Bench* bench() noexcept { return nullptr; }

  /// Returns the quality of the connection, or none for a local device. Not while another
  /// thread reads or writes.
  [[nodiscard]] virtual std::optional<LinkReport> link() const noexcept { return std::nullopt; }

  /// Returns what the hand has felt, if the device is a simulation that knows it. Real time.
  [[nodiscard]] virtual core::ContactSums contact_sums() const noexcept { return {}; }
};

}  // namespace jnd::device
