#include "core/safety/guard.h"

namespace jnd::core {

std::string_view warning_words(Fault guard) noexcept {
  switch (guard) {
    case Fault::kOutsideWorkspace:
      return "The hand is near the edge of its space";
    case Fault::kEnergyGiven:
      return "The force pushes the hand along a little";
    case Fault::kForceOscillates:
      return "The force swings to and fro";
    case Fault::kVelocityContradicts:
      return "Velocity and positions disagree a little";
    case Fault::kPositionFrozen:
      return "The hand is too still, ask it to move";
    default:
      return "";
  }
}

}  // namespace jnd::core
