#pragma once

#include <string>

#include "chaos/door_schedule.h"
#include "chaos/schedule.h"

namespace jnd::chaos {

/// What became of a schedule.
struct Outcome {
  std::string violation;  ///< Empty: none.
  int num_milliseconds_with_force = 0;
  double most_given_j = 0.0;
  std::string story;       ///< What happened when, of what is no function of the seed.
  bool was_played = true;  ///< False: what it needs is not there.
};

/// In virtual time, all of it in this thread.
[[nodiscard]] Outcome played_directly(const Schedule& schedule);
[[nodiscard]] Outcome played_over_a_network(const Schedule& schedule);

/// The real program, in real time. Not played where none was built.
[[nodiscard]] Outcome played_by_processes(const Schedule& schedule);

/// The same on devices of other programs, which keep a record of what they were given.
[[nodiscard]] Outcome played_through_a_door(const DoorSchedule& schedule);

}  // namespace jnd::chaos
