#pragma once

#include <string>

#include "chaos/door_schedule.h"
#include "chaos/schedule.h"

namespace jnd::chaos {

/// The result of playing a schedule.
struct Outcome {
  std::string violation;  ///< "" if there was none.
  int num_milliseconds_with_force = 0;
  double most_given_j = 0.0;
  std::string story;       ///< What happened when, as far as it is no function of the seed.
  bool was_played = true;  ///< False if something that the schedule needs is missing.
};

/// Plays a schedule in virtual time, all of it in this thread.
[[nodiscard]] Outcome played_directly(const Schedule& schedule);
[[nodiscard]] Outcome played_over_a_network(const Schedule& schedule);

/// Plays the real program in real time. The schedule is not played if no program was built.
[[nodiscard]] Outcome played_by_processes(const Schedule& schedule);

/// Plays the real program on devices of other programs, which keep a record of the forces that
/// they were given.
[[nodiscard]] Outcome played_through_a_door(const DoorSchedule& schedule);

}  // namespace jnd::chaos
