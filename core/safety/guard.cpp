#include "core/safety/guard.h"

#include "core/for_people.h"

namespace jnd::core {

std::string_view warning_words(Fault guard) noexcept {
  switch (guard) {
    case Fault::kOutsideWorkspace:
      return for_people("The hand is near the edge of its space");
    case Fault::kEnergyGiven:
      return for_people("The force pushes the hand along a little");
    case Fault::kForceOscillates:
      return for_people("The force swings to and fro");
    case Fault::kVelocityContradicts:
      return for_people("Velocity and positions disagree a little");
    case Fault::kPositionFrozen:
      return for_people("The hand is too still, ask it to move");
    default:
      return "";
  }
}

}  // namespace jnd::core
