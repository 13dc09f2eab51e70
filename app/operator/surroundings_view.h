#pragma once

#include "core/media/immersion.h"

namespace jnd::app {

/// What is around the hand: where the fluid ends, and what of it is solid.
struct SurroundingsView {
  core::Immersion immersion;
  bool surface_is_solid = false;  ///< In the medium being felt.
  /// There are walls and a floor where the immersion ends.
  bool has_walls = false;
};

}  // namespace jnd::app
