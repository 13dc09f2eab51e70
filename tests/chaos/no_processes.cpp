#include "chaos/worlds.h"

// Replaces process_world.cpp and door_world.cpp in a campaign without storage and without the
// program.

namespace jnd::chaos {

Outcome played_by_processes(const Schedule&) { return {.was_played = false}; }
Outcome played_through_a_door(const DoorSchedule&) { return {.was_played = false}; }

}  // namespace jnd::chaos
