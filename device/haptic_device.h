#pragma once

#include <string_view>

#include "core/contact_sums.h"
#include "core/haptic_state.h"

namespace jnd::device {

struct DeviceCapabilities {
  int num_contact_points = core::kNumContactPoints;
  double rate_hz = 1000.0;              ///< Of its control loop.
  double max_force_per_point_n = 10.0;  ///< What it can render at one point.
  double max_total_force_n = 30.0;      ///< Sum over the points.
  bool simulated = false;               ///< No person can be hurt by it.
  bool moves_by_itself = false;         ///< By a simulated arm: nobody has to be there.
};

/// A device that holds a hand at five points. Everything it takes and gives is in SI units and
/// in the workspace frame of `core::HapticState`; a device with another frame transforms
/// inside. Forces are those that act on the hand, not on the device.
///
/// Used by one thread at a time. A real device zeroes its force by itself when writes stop.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  /// As in the registry and on the command line. Real time.
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  [[nodiscard]] virtual DeviceCapabilities capabilities() const noexcept = 0;

  /// Throws `core::Error`: the device cannot be used, and why. Motors may be on afterwards, so
  /// check for real time first (`require_realtime`). Not real time.
  virtual void open() = 0;

  /// The newest measurement. False: there was none; `state` is then undefined. Real time.
  [[nodiscard]] virtual bool read(core::HapticState& state) noexcept = 0;

  /// Applies these forces until the next write; a simulated device moves on by its period.
  /// False: they were not taken. Real time.
  [[nodiscard]] virtual bool write(const core::PointVectors& force_on_hand_n) noexcept = 0;

  /// Zero force, motors off. May be called twice. Not real time.
  virtual void close() noexcept = 0;

  /// What the hand has been through, where the device knows it: a simulation. Real time.
  [[nodiscard]] virtual core::ContactSums contact_sums() const noexcept { return {}; }
};

}  // namespace jnd::device
