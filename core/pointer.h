#pragma once

#include <cstdint>
#include <type_traits>

namespace jnd::core {

/// Where a person holds the hand by a pointer, in the workspace frame. Trivially copyable,
/// because it crosses from the window to the haptic thread through a `LatestValue`.
struct PointerPosition {
  std::uint64_t sequence = 0;  ///< Increases with every position; 0 means "none yet".
  double x_m = 0.0;            ///< To the participant's right.
  double y_m = 0.0;            ///< Away from the participant.
};

static_assert(std::is_trivially_copyable_v<PointerPosition>);

}  // namespace jnd::core
