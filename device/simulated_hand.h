#pragma once

#include <cstdint>

#include "core/random_stream.h"
#include "device/stroking_arm.h"

namespace jnd::device {

/// A simulated person's hand on a simulated device, told from outside what to do. Orders take
/// effect in the device's next tick. Used by one thread, which need not be the loop's.
class SimulatedHand {
 public:
  virtual ~SimulatedHand() = default;

  /// Throws `core::Error` for a plan out of range.
  virtual void begin_strokes(const StrokePlan& plan, const core::RandomStream& random) = 0;
  virtual void go_home() noexcept = 0;
  /// Whole strokes since the last `begin_strokes`.
  [[nodiscard]] virtual std::int64_t strokes_finished() const noexcept = 0;
  /// The arm has come to rest at home since the last order.
  [[nodiscard]] virtual bool is_home() const noexcept = 0;
  /// Puts back every finger of the device that came off, which takes its time. Nothing to do
  /// for a hand that cannot lose one.
  virtual void put_fingers_back() noexcept {}
};

}  // namespace jnd::device
