#include "app/session/missing_force.h"

#include <fmt/format.h>

#include "core/for_people.h"

namespace jnd::app {

bool asks_for_force(const core::MediumAmounts& medium) noexcept {
  core::MediumAmounts felt = medium;
  felt.container_stiffness_n_per_m = 0.0;
  felt.container_damping_n_s_per_m = 0.0;
  felt.container_friction_n_per_m = 0.0;
  return felt != core::MediumAmounts{};
}

std::string missing_force_cause(const core::ForceCounts& meanwhile) {
  if (meanwhile.num_acted > 0) return "";
  if (meanwhile.num_sent > 0) {
    return core::for_people(
        "forces were sent, and the device tells or measures that none acted; look at its "
        "motors, its enabling switch and what it tells of the force that acted");
  }
  if (meanwhile.num_held == 0) {
    return core::for_people(
        "the device tells of no point that it holds the hand; close its magnets, or tell the "
        "points in its driver");
  }
  if (meanwhile.num_immersed == 0) {
    return core::for_people(
        "the hand was never in the medium; move it there, or look at the units and the frame "
        "of the device's positions");
  }
  if (meanwhile.num_moved == 0) {
    return core::for_people(
        "the device tells that the hand did not move at all; move it, or look at the "
        "velocities that the device tells");
  }
  return core::for_people(
      "the program sent no force at all; look whether the hand touched the surface, and "
      "whether the device was armed");
}

std::string missing_force_words(std::int64_t num_presentations, const std::string& cause) {
  if (num_presentations == 0) return "";
  return fmt::format("no force acted in {} presentation{} of stimuli that ask for one: {}",
                     num_presentations, num_presentations == 1 ? "" : "s", cause);
}

}  // namespace jnd::app
