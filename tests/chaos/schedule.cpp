#include "chaos/schedule.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <sstream>

#include "core/hand.h"
#include "core/random_stream.h"

namespace jnd::chaos {
namespace {

constexpr double kShareOfProcesses = 0.05;
constexpr int kNumFields = 12;  ///< Three axes of each of the four vectors of a measurement.

struct TroubleKind {
  Trouble what;
  std::string_view name;
  bool direct, network;
  int shortest_ms, longest_ms;
  double least, most;
};

/// A new trouble needs a line here, a name in `Trouble`, and a few lines where it happens.
constexpr std::array kTroubles = {
    TroubleKind{Trouble::kArm, "somebody arms", true, true, 0, 0, 0, 0},
    TroubleKind{Trouble::kDisarm, "somebody disarms", true, true, 0, 0, 0, 0},
    TroubleKind{Trouble::kPressStop, "the stop is pressed", true, true, 0, 0, 0, 0},
    TroubleKind{Trouble::kReleaseStop, "the stop is released", true, true, 0, 0, 0, 0},
    TroubleKind{Trouble::kPressStopWithinTick, "the stop is pressed within a tick", true, false,
                0, 0, 0, 0},
    TroubleKind{Trouble::kNewMedium, "another medium, in Pa s", true, true, 0, 0, 0.0, 21.0},
    TroubleKind{Trouble::kBrokenMedium, "a medium that is no number", true, true, 0, 0, 0, 0},
    TroubleKind{Trouble::kLoopStalls, "the loop stalls", true, true, 1, 60, 0, 0},
    TroubleKind{Trouble::kLoopHeldUpWithinTick, "the loop is held up within a tick, in ms",
                true, false, 0, 0, 1.0, 60.0},
    TroubleKind{Trouble::kWindowStalls, "the window stalls", true, true, 50, 900, 0, 0},
    TroubleKind{Trouble::kServerStalls, "the server stalls", false, true, 1, 60, 0, 0},
    TroubleKind{Trouble::kProgramStops, "the program is stopped", true, true, 1, 400, 0, 0},
    TroubleKind{Trouble::kProgramIsKilled, "the program is killed", true, true, 5, 600, 0, 0},
    TroubleKind{Trouble::kServerRestarts, "the server restarts", false, true, 1, 300, 0, 0},
    TroubleKind{Trouble::kUnplugged, "the device is unplugged", true, true, 1, 400, 0, 0},
    TroubleKind{Trouble::kNoNumber, "NaN in the measurement", true, true, 1, 3, 0, 0},
    TroubleKind{Trouble::kInfinity, "infinity in the measurement", true, true, 1, 3, 0, 0},
    TroubleKind{Trouble::kPositionsFreeze, "positions freeze", true, true, 1, 300, 0, 0},
    TroubleKind{Trouble::kReadingFreezes, "the reading freezes", true, true, 1, 300, 0, 0},
    TroubleKind{Trouble::kVelocitySign, "the velocity's sign is wrong", true, true, 1, 600, 0,
                0},
    TroubleKind{Trouble::kReadingLate, "the reading is late, in ms", true, true, 20, 800, 0.0,
                50.0},
    TroubleKind{Trouble::kForceLate, "the force is late, in ms", true, true, 20, 800, 0.0,
                50.0},
    TroubleKind{Trouble::kReadsFail, "reads fail", true, true, 1, 20, 0, 0},
    TroubleKind{Trouble::kWritesFail, "writes fail", true, true, 1, 20, 0, 0},
    TroubleKind{Trouble::kPointComesOff, "a point comes off", true, true, 1, 300, 0, 0},
    TroubleKind{Trouble::kLeap, "a point leaps, in m", true, true, 1, 50, 0.2, 1.0},
    TroubleKind{Trouble::kTooFast, "a velocity leaps, in m/s", true, true, 1, 5, 8.0, 60.0},
    TroubleKind{Trouble::kLoses, "datagrams are lost", false, true, 5, 600, 0.01, 1.0},
    TroubleKind{Trouble::kDoubles, "datagrams come twice", false, true, 5, 600, 0.05, 1.0},
    TroubleKind{Trouble::kDelays, "datagrams are late, in ms", false, true, 5, 600, 1.0, 50.0},
    TroubleKind{Trouble::kReorders, "datagrams overtake, in ms", false, true, 5, 600, 1.0,
                10.0},
    TroubleKind{Trouble::kCorrupts, "datagrams are corrupted", false, true, 5, 600, 0.01, 1.0},
    TroubleKind{Trouble::kReplays, "old datagrams come again", false, true, 5, 600, 0.05, 1.0},
};

bool happens_in(const TroubleKind& kind, World world) {
  return world == World::kDirect ? kind.direct : kind.network;
}

Event drawn_event(core::RandomStream& random, const TroubleKind& kind, int at_ms) {
  const auto span_ms = static_cast<std::uint64_t>(kind.longest_ms - kind.shortest_ms + 1);
  return {.at_ms = at_ms,
          .lasts_ms = kind.shortest_ms + static_cast<int>(random.below(span_ms)),
          .what = kind.what,
          .point = static_cast<int>(random.below(core::kNumContactPoints)),
          .field = static_cast<int>(random.below(kNumFields)),
          .size = random.uniform(kind.least, kind.most)};
}

/// Adds the acts of people, who arm again and again, and release a stop after it was pressed.
void add_acts_of_people(core::RandomStream& random, Schedule& schedule) {
  std::vector<Event> acts;
  for (int at_ms = 20 + static_cast<int>(random.below(300)); at_ms < schedule.lasts_ms;
       at_ms += 300 + static_cast<int>(random.below(900))) {
    acts.push_back({.at_ms = at_ms, .what = Trouble::kArm});
  }
  for (const Event& event : schedule.events) {
    if (event.what != Trouble::kPressStop && event.what != Trouble::kPressStopWithinTick) {
      continue;
    }
    // Now and then people press all keys at once, in any order.
    const bool is_hasty = random.with_probability(0.3);
    const int least_ms = is_hasty ? event.at_ms - 2 : event.at_ms;
    const std::uint64_t within_ms = is_hasty ? 5 : 800;
    const auto soon_ms = [&] { return least_ms + static_cast<int>(random.below(within_ms)); };
    acts.push_back({.at_ms = soon_ms(), .what = Trouble::kReleaseStop});
    if (!is_hasty) continue;
    acts.push_back({.at_ms = soon_ms(), .what = Trouble::kArm});
    // Then the loop does not look in the meantime.
    acts.push_back({.at_ms = least_ms, .lasts_ms = 6, .what = Trouble::kLoopStalls});
  }
  schedule.events.insert(schedule.events.end(), acts.begin(), acts.end());
}

void draw_events(core::RandomStream& random, Schedule& schedule) {
  const int num = 1 + static_cast<int>(random.below(14));
  while (static_cast<int>(schedule.events.size()) < num) {
    const TroubleKind& kind = kTroubles[random.below(kTroubles.size())];
    const auto last_ms = static_cast<std::uint64_t>(schedule.lasts_ms);
    const int at_ms = static_cast<int>(random.below(last_ms));
    const Event event = drawn_event(random, kind, at_ms);
    if (happens_in(kind, schedule.world)) schedule.events.push_back(event);
  }
  add_acts_of_people(random, schedule);
  std::ranges::stable_sort(schedule.events, {}, &Event::at_ms);
}

/// A program that is stopped or gone has no watchdog. The device has to notice that by itself.
bool needs_a_device_that_zeroes_by_itself(const Schedule& schedule) {
  return std::ranges::any_of(schedule.events, [](const Event& event) {
    return event.what == Trouble::kProgramStops || event.what == Trouble::kProgramIsKilled ||
           event.what == Trouble::kUnplugged;
  });
}

World drawn_world(core::RandomStream& random) {
  if (random.with_probability(kShareOfProcesses)) return World::kProcess;
  return random.with_probability(0.5) ? World::kDirect : World::kNetwork;
}

int drawn_lateness_ms(core::RandomStream& random) {
  return random.with_probability(0.8) ? 0 : static_cast<int>(random.below(51));
}

bool is_any_on(const Schedule& schedule, std::initializer_list<Trouble> kinds, int from_ms,
               int to_ms) noexcept {
  return std::ranges::any_of(schedule.events, [&](const Event& event) {
    return event.overlaps(from_ms, to_ms) &&
           std::find(kinds.begin(), kinds.end(), event.what) != kinds.end();
  });
}

std::string_view name_of(World world) {
  switch (world) {
    case World::kDirect:
      return "loop and device in one program";
    case World::kNetwork:
      return "a network between loop and device";
    case World::kProcess:
      return "the real program";
  }
  return "";
}

}  // namespace

std::string_view name(Trouble what) noexcept {
  const auto kind = std::ranges::find(kTroubles, what, &TroubleKind::what);
  return kind == kTroubles.end() ? "" : kind->name;
}

const Event* Schedule::on(Trouble what, int now_ms) const noexcept {
  const auto found = std::ranges::find_if(
      events, [&](const Event& event) { return event.what == what && event.is_on(now_ms); });
  return found == events.end() ? nullptr : &*found;
}

bool Schedule::is_disturbed(int from_ms, int to_ms) const noexcept {
  return has_late_datagrams(from_ms, to_ms) ||
         is_any_on(*this,
                   {Trouble::kLoopStalls, Trouble::kProgramStops, Trouble::kProgramIsKilled,
                    Trouble::kServerRestarts, Trouble::kUnplugged, Trouble::kLoses,
                    Trouble::kCorrupts},
                   from_ms, to_ms);
}

bool Schedule::has_late_datagrams(int from_ms, int to_ms) const noexcept {
  return is_any_on(*this,
                   {Trouble::kServerStalls, Trouble::kDoubles, Trouble::kDelays,
                    Trouble::kReorders, Trouble::kReplays},
                   from_ms, to_ms);
}

bool Schedule::may_let_a_force_stand() const noexcept {
  return is_disturbed(0, lasts_ms) ||
         is_any_on(*this,
                   {Trouble::kLoopHeldUpWithinTick, Trouble::kPositionsFreeze,
                    Trouble::kReadingFreezes},
                   0, lasts_ms);
}

int Schedule::most_late_ms() const noexcept {
  const auto most = [&](Trouble what) {
    double most_ms = 0.0;
    for (const Event& event : events) {
      if (event.what == what) most_ms = std::max(most_ms, event.size);
    }
    return static_cast<int>(most_ms);
  };
  return reading_late_ms + force_late_ms + most(Trouble::kReadingLate) +
         most(Trouble::kForceLate) + most(Trouble::kDelays) + most(Trouble::kReorders);
}

Schedule drawn_schedule(std::uint64_t seed) {
  core::RandomStream random(seed, "chaos");
  Schedule schedule{.seed = seed, .world = drawn_world(random)};
  schedule.lasts_ms = 1500 + static_cast<int>(random.below(3000));
  constexpr std::array kMasses_kg = {0.03, 0.1, 0.3, 0.6, 1.0, 2.0};
  schedule.hand_mass_kg = kMasses_kg[random.below(kMasses_kg.size())];
  schedule.stroke_m = random.uniform(0.03, 0.15);
  schedule.stroke_hz = random.uniform(0.3, 1.5);
  schedule.filter_hz = random.with_probability(0.3) ? random.uniform(20.0, 80.0) : 0.0;
  schedule.reading_late_ms = drawn_lateness_ms(random);
  schedule.force_late_ms = drawn_lateness_ms(random);
  schedule.viscosity_pa_s = random.uniform(1.0, 21.0);
  schedule.zeroes_by_itself = schedule.world != World::kDirect || random.with_probability(0.3);
  draw_events(random, schedule);
  schedule.zeroes_by_itself |= needs_a_device_that_zeroes_by_itself(schedule);
  return schedule;
}

std::string told(const Schedule& schedule) {
  std::ostringstream text;
  text << "seed " << schedule.seed << ": " << name_of(schedule.world) << ", "
       << schedule.lasts_ms << " ms, a hand of " << schedule.hand_mass_kg << " kg in "
       << schedule.viscosity_pa_s << " Pa s, strokes of " << schedule.stroke_m << " m at "
       << schedule.stroke_hz << " Hz, velocity filtered at " << schedule.filter_hz
       << " Hz, reading " << schedule.reading_late_ms << " ms and force "
       << schedule.force_late_ms << " ms late"
       << (schedule.zeroes_by_itself ? ", a device that zeroes by itself\n" : "\n");
  for (const Event& event : schedule.events) {
    text << "  " << event.at_ms << " ms: " << name(event.what);
    if (event.lasts_ms > 0) text << " for " << event.lasts_ms << " ms";
    text << " (" << event.size << ", point " << event.point << ", field " << event.field
         << ")\n";
  }
  return text.str();
}

}  // namespace jnd::chaos
