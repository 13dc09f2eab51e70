#pragma once

#include <string_view>

#include "core/exchange/latest_value.h"
#include "core/pointer.h"
#include "device/drawn_mass.h"
#include "device/halt_latch.h"
#include "device/haptic_device.h"
#include "device/pointer_guide.h"

namespace jnd::device {

/// A hand that a person moves with a mouse, and sees instead of feels. One `DrawnMass` hangs on
/// the pointer's smoothed path (`PointerGuide`) by a spring and a damper,
///
///   mass (a - a_pointer) = rendered force + stiffness (x_pointer - x) + damping (v_pointer -
///   v),
///
/// at a fixed height. The arm carries the hand's own weight, so in free space the hand follows
/// the pointer. A medium holds it back by force / stiffness, so the drawn hand lags behind the
/// cursor in proportion to the drag. Vision alone can convey a resistance in this way: Lecuyer
/// et al. 2000, "Pseudo-haptic feedback".
///
/// The spring is softer than an arm, so that the lag is visible. In strokes 0.3 m wide, one a
/// second, the hand is 3 cm behind in free space, 5 to 11 cm in water of scale 0.5 to 4, and 8
/// to 14 cm at 3 to 21 Pa s, where its strokes are still 0.22 to 0.07 m wide.
///
/// The part of the rendered force that opposes the motion enters as implicit damping. So it
/// stops the hand, however thick the medium, and never reverses it within a tick. The hand
/// never exceeds `max_speed_m_per_s`, not even if a medium that held it back disappears at
/// once.
///
/// `read`, `write` and `contact_sums` are for the loop's thread. One other thread may publish.
class MouseDevice final : public HapticDevice {
 public:
  struct Parameters {
    double rate_hz = 1000.0;          ///< Rate of the loop that drives it, > 0.
    double mass_kg = 0.1;             ///< > 0.
    double stiffness_n_per_m = 60.0;  ///< > 0.
    double damping_n_s_per_m = 5.0;   ///< >= 0; the critical value is 2 sqrt(mass stiffness).
    double height_m = -0.15;          ///< Height of the hand in the workspace frame.
    double max_speed_m_per_s = 2.5;   ///< Of the hand, > 0.
    PointerGuide::Parameters guide;
    double max_force_per_point_n = 10.0;  ///< > 0.
    double max_total_force_n = 30.0;      ///< > 0.
  };

  /// Throws `core::Error` naming the field. `pointer` must outlive the device; with nullptr the
  /// device has one of its own. Not real time.
  explicit MouseDevice(const Parameters& parameters,
                       core::LatestValue<core::PointerPosition>* pointer = nullptr);

  /// Returns where to publish the pointer, each time with a new sequence number.
  [[nodiscard]] core::LatestValue<core::PointerPosition>& pointer() noexcept {
    return *pointer_;
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "mouse"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  /// Puts the hand at rest in the middle, with time and sums at 0.
  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override {}
  void halt() noexcept override { halt_.halt(); }
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override {
    return hand_.sums();
  }

 private:
  Parameters parameters_;
  core::LatestValue<core::PointerPosition> own_pointer_;
  core::LatestValue<core::PointerPosition>* pointer_;
  PointerGuide guide_;
  DrawnMass hand_;
  HaltLatch halt_;
};

}  // namespace jnd::device
