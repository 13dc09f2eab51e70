#include "chaos/door_schedule.h"

#include <array>
#include <sstream>

#include "core/random_stream.h"

namespace jnd::chaos {
namespace {

constexpr std::uint64_t kSeedsADoor = 20;
constexpr std::uint64_t kFirstOfThem = 17;

/// Returns each trouble that can happen behind this door.
std::vector<DoorTrouble> troubles_of(Door door) {
  std::vector<DoorTrouble> all = {DoorTrouble::kProgramKilled, DoorTrouble::kProgramStopped,
                                  DoorTrouble::kAllStopped};
  if (is_networked(door)) {
    all.insert(all.end(), {DoorTrouble::kServerKilled, DoorTrouble::kServerStopped});
  }
  if (has_driver(door)) {
    all.insert(all.end(),
               {DoorTrouble::kHostKilled, DoorTrouble::kHostStopped, DoorTrouble::kUnplugged});
  }
  return all;
}

int drawn_ms(core::RandomStream& random, int least_ms, int most_ms) {
  const auto span_ms =
      static_cast<std::uint64_t>(most_ms) - static_cast<std::uint64_t>(least_ms) + 1;
  return least_ms + static_cast<int>(random.below(span_ms));
}

}  // namespace

bool is_networked(Door door) noexcept {
  return door == Door::kCDevice || door == Door::kPythonDevice || door == Door::kServedDriver;
}

bool has_driver(Door door) noexcept {
  return door != Door::kCDevice && door != Door::kPythonDevice;
}

bool is_played_through_a_door(std::uint64_t seed) noexcept {
  return seed % kSeedsADoor == kFirstOfThem;
}

DoorSchedule drawn_door_schedule(std::uint64_t seed) {
  core::RandomStream random(seed, "doors");
  DoorSchedule schedule{.seed = seed};
  // The doors take turns, whether all seeds are played through doors or one in twenty.
  schedule.door = static_cast<Door>((seed + seed / kSeedsADoor) % kNumDoors);
  schedule.has_key = is_networked(schedule.door) && random.with_probability(0.5);
  constexpr std::array kPoints = {31U, 31U, 1U, 12U};
  schedule.points = kPoints[random.below(kPoints.size())];
  const std::vector<DoorTrouble> troubles = troubles_of(schedule.door);
  const int num = drawn_ms(random, 1, 4);
  for (int i = 0; i < num; ++i) {
    schedule.events.push_back({.what = troubles[random.below(troubles.size())],
                               .is_at_once = i > 0 && random.with_probability(0.25),
                               .after_ms = drawn_ms(random, 0, 600),
                               .lasts_ms = drawn_ms(random, 5, 600),
                               .is_resumed_at_once = random.with_probability(0.3)});
  }
  return schedule;
}

DoorSchedule wrong_door_schedule(std::uint64_t seed) {
  struct Wrong {
    Door door;
    DoorTrouble trouble;
    const char* what;
  };
  constexpr std::array kWrong = {
      Wrong{Door::kDriver, DoorTrouble::kProgramStopped, "halt"},
      Wrong{Door::kPacingDriver, DoorTrouble::kProgramStopped, "limits"},
      Wrong{Door::kPythonDevice, DoorTrouble::kProgramKilled, "silence"}};
  const Wrong& wrong = kWrong[(seed - 1) % kWrong.size()];
  return {.seed = seed,
          .door = wrong.door,
          .events = {{.what = wrong.trouble, .after_ms = 300, .lasts_ms = 1000}},
          .wrong = wrong.what};
}

std::string told(const DoorSchedule& schedule) {
  std::ostringstream text;
  text << "seed " << schedule.seed << ": the real program and " << name(schedule.door);
  if (is_networked(schedule.door))
    text << (schedule.has_key ? ", with a key" : ", without a key");
  if (has_driver(schedule.door)) text << ", points " << schedule.points;
  if (!schedule.wrong.empty()) text << ", wrong: " << schedule.wrong;
  text << '\n';
  for (const DoorEvent& event : schedule.events) {
    text << "  ";
    if (event.is_at_once) {
      text << "at once: ";
    } else {
      text << event.after_ms << " ms after force was seen: ";
    }
    text << name(event.what) << " for " << event.lasts_ms << " ms"
         << (event.is_resumed_at_once ? ", resumed at once\n" : "\n");
  }
  return text.str();
}

std::string_view name(Door door) noexcept {
  switch (door) {
    case Door::kDriver:
      return "a driver";
    case Door::kPacingDriver:
      return "a driver that sets the pace";
    case Door::kCDevice:
      return "the device in C";
    case Door::kPythonDevice:
      return "the device in Python";
    case Door::kServedDriver:
      return "a driver behind a server";
  }
  return "";
}

std::string_view name(DoorTrouble what) noexcept {
  switch (what) {
    case DoorTrouble::kProgramKilled:
      return "the program was killed";
    case DoorTrouble::kProgramStopped:
      return "the program was stopped";
    case DoorTrouble::kServerKilled:
      return "the server was killed";
    case DoorTrouble::kServerStopped:
      return "the server was stopped";
    case DoorTrouble::kHostKilled:
      return "the driver's process was killed";
    case DoorTrouble::kHostStopped:
      return "the driver's process was stopped";
    case DoorTrouble::kUnplugged:
      return "the device was unplugged";
    case DoorTrouble::kAllStopped:
      return "everything was stopped";
  }
  return "";
}

}  // namespace jnd::chaos
