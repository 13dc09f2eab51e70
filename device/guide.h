#pragma once

#include "core/hand.h"
#include "core/haptic_state.h"

namespace jnd::device {

/// Moves a device by a force of its own while it is measured without a hand in it. A loop with
/// a guide (`HapticLoop::Parameters::guide`) adds its force to that of the medium, after
/// passivity, because it has to give energy, and before the limiter. No session has a guide.
class Guide {
 public:
  virtual ~Guide() = default;

  /// Returns what to add at each point, in the device's workspace frame. It is called once in
  /// each tick in which there may be force. The loop scales it while it arms. Real time.
  [[nodiscard]] virtual core::PointVectors force_n(const core::HapticState& state,
                                                   double period_s) noexcept = 0;
};

}  // namespace jnd::device
