#pragma once

#include <cstdint>

#include "core/random_stream.h"
#include "device/stroking_arm.h"

namespace jnd::device {

/// A simulated person's hand on a simulated device, which takes orders from outside. Orders
/// take effect in the device's next tick. One thread may use it, which need not be the loop's.
class SimulatedHand {
 public:
  virtual ~SimulatedHand() = default;

  /// Throws `core::Error` for a plan out of range.
  virtual void begin_strokes(const StrokePlan& plan, const core::RandomStream& random) = 0;
  virtual void go_home() noexcept = 0;
  /// Returns the number of whole strokes since the last `begin_strokes`.
  [[nodiscard]] virtual std::int64_t strokes_finished() const noexcept = 0;
  /// Whether the arm has come to rest at home since the last order.
  [[nodiscard]] virtual bool is_home() const noexcept = 0;
  /// Puts back every finger of the device that came off, which takes some time. It does nothing
  /// for a hand that cannot lose one.
  virtual void put_fingers_back() noexcept {}
};

}  // namespace jnd::device
