#pragma once

#include <string_view>

#include "core/exchange/latest_value.h"
#include "core/pointer.h"
#include "device/drawn_mass.h"
#include "device/halt_latch.h"
#include "device/haptic_device.h"
#include "device/pointer_guide.h"

namespace jnd::device {

/// A hand that a person draws with a mouse, and sees instead of feels. One `DrawnMass` hangs on
/// the pointer's smoothed way (`PointerGuide`) by a spring and a damper,
///
///     mass (a - a_pointer) = rendered force + stiffness (x_pointer - x)
///                            + damping (v_pointer - v),
///
/// at a fixed height. The arm carries the hand's own weight, so in free space the hand goes
/// with the pointer's way; a medium holds it back by force / stiffness, and the drawn hand
/// lags behind the cursor in proportion to the drag. That vision alone can so convey a
/// resistance: Lecuyer et al. 2000, "Pseudo-haptic feedback".
///
/// Soft enough for eyes, so softer than an arm: in strokes 0.3 m wide, one a second, the hand
/// is 3 cm behind in free space, 5 to 11 cm in water of scale 0.5 to 4, and 8 to 14 cm at 3 to
/// 21 Pa s, where its strokes are still 0.22 to 0.07 m wide.
///
/// What of the rendered force opposes the motion enters as damping, implicitly: it stops the
/// hand, however thick the medium, and never turns it round within a tick. The hand is never
/// faster than `max_speed_m_per_s`, not even when a medium that held it back is gone at once.
///
/// `read`, `write` and `contact_sums` belong to the loop's thread; one other may publish.
class MouseDevice final : public HapticDevice {
 public:
  struct Parameters {
    double rate_hz = 1000.0;          ///< Of the loop that drives it, > 0.
    double mass_kg = 0.1;             ///< > 0.
    double stiffness_n_per_m = 60.0;  ///< > 0.
    double damping_n_s_per_m = 5.0;   ///< >= 0; critical is 2 sqrt(mass stiffness).
    double height_m = -0.15;          ///< Of the hand, workspace frame.
    double max_speed_m_per_s = 2.5;   ///< Of the hand, > 0.
    PointerGuide::Parameters guide;
    double max_force_per_point_n = 10.0;  ///< > 0.
    double max_total_force_n = 30.0;      ///< > 0.
  };

  /// Throws `core::Error` naming the field. `pointer` has to outlive the device; nullptr: it
  /// has one of its own. Not real time.
  explicit MouseDevice(const Parameters& parameters,
                       core::LatestValue<core::PointerPosition>* pointer = nullptr);

  /// Where the pointer is to be published, with a new sequence each time.
  [[nodiscard]] core::LatestValue<core::PointerPosition>& pointer() noexcept {
    return *pointer_;
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "mouse"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  /// The hand at rest in the middle, time and sums at 0.
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
