#pragma once

#include <string>

#include "chaos/door_schedule.h"
#include "chaos/schedule.h"

namespace jnd::chaos {

/// The outcome of a schedule.
struct Outcome {
  std::string violation;  ///< It is empty if there was no violation.
  int num_milliseconds_with_force = 0;
  double most_given_j = 0.0;
  std::string story;       ///< What happened when, as far as the seed does not determine it.
  bool was_played = true;  ///< False if this machine lacks what the schedule needs.
};

/// Plays a schedule in virtual time, in this thread alone.
[[nodiscard]] Outcome played_directly(const Schedule& schedule);
[[nodiscard]] Outcome played_over_a_network(const Schedule& schedule);

/// Plays the real program in real time. If no program was built, nothing is played.
[[nodiscard]] Outcome played_by_processes(const Schedule& schedule);

/// Plays the real program on devices of other programs, which record what they were given.
[[nodiscard]] Outcome played_through_a_door(const DoorSchedule& schedule);

}  // namespace jnd::chaos
