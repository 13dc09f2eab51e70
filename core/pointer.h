#pragma once

#include <cstdint>
#include <type_traits>

namespace jnd::core {

/// Where a person holds the hand by a pointer, workspace frame. Trivially copyable: it crosses
/// from the window to the haptic thread through a `LatestValue`.
struct PointerPosition {
  std::uint64_t sequence = 0;  ///< Rises with every position; 0 is "none yet".
  double x_m = 0.0;            ///< To the participant's right.
  double y_m = 0.0;            ///< Away from the participant.
};

static_assert(std::is_trivially_copyable_v<PointerPosition>);

}  // namespace jnd::core
