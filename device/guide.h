#pragma once

#include "core/hand.h"
#include "core/haptic_state.h"

namespace jnd::device {

/// Moves a device by a force of its own while it is measured: there is no hand in it. A loop
/// that has one (`HapticLoop::Parameters::guide`) adds its force to that of the medium, after
/// passivity, for it has to give energy, and before the limiter. No session has one.
class Guide {
 public:
  virtual ~Guide() = default;

  /// Once a tick in which there may be force: what to add at each point, workspace frame of the
  /// device. The loop scales it while it arms. Real time.
  [[nodiscard]] virtual core::PointVectors force_n(const core::HapticState& state,
                                                   double period_s) noexcept = 0;
};

}  // namespace jnd::device
