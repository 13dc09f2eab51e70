#include <charconv>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "chaos/worlds.h"

// The campaign plays random schedules in which anything may go wrong at once. `./dev chaos`
// runs it.

namespace {

using namespace jnd::chaos;

struct Arguments {
  std::uint64_t num_schedules = 1000;
  std::uint64_t first_seed = 1;
  bool in_virtual_time = false;  ///< Leaves out the real program.
  /// Plays nothing but the real program on other people's devices.
  bool through_doors = false;
  /// Prints each schedule through a door before it is played, and how long it took.
  bool tells_all = false;
  bool wrong_devices = false;  ///< Plays devices that are wrong on purpose and must be found.
  bool ends_at_first = false;  ///< Ends at the first violation.
  /// Prints a line for each schedule, from which the bound of the energy is derived.
  bool measures_energy = false;
};

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Arguments> read_arguments(int num, char** words) {
  Arguments arguments;
  int num_numbers = 0;
  for (int i = 1; i < num; ++i) {
    const std::string_view word = words[i];
    if (word == "--virtual-time" || word == "--first" || word == "--energy" ||
        word == "--doors" || word == "--wrong-devices" || word == "--tell") {
      arguments.in_virtual_time |= word == "--virtual-time";
      arguments.ends_at_first |= word == "--first";
      arguments.measures_energy |= word == "--energy";
      arguments.through_doors |= word == "--doors";
      arguments.wrong_devices |= word == "--wrong-devices";
      arguments.tells_all |= word == "--tell";
      continue;
    }
    const auto value = number(word);
    if (!value || num_numbers == 2) return std::nullopt;
    (num_numbers++ == 0 ? arguments.num_schedules : arguments.first_seed) = *value;
  }
  return arguments;
}

Outcome played(const Schedule& schedule, const Arguments& arguments) {
  switch (schedule.world) {
    case World::kDirect:
      return played_directly(schedule);
    case World::kNetwork:
      return played_over_a_network(schedule);
    case World::kProcess:
      return arguments.in_virtual_time ? Outcome{.was_played = false}
                                       : played_by_processes(schedule);
  }
  return {};
}

struct Counts {
  std::uint64_t num_played = 0, num_failed = 0, num_left_out = 0, num_with_force = 0;
};

/// Returns whether this seed is played through a door. If only virtual time is wanted, these
/// seeds are played in virtual time as well.
bool is_for_a_door(std::uint64_t seed, const Arguments& arguments) {
  if (arguments.in_virtual_time) return false;
  return arguments.through_doors || is_played_through_a_door(seed);
}

void tell_violation(const std::string& schedule, std::uint64_t seed, const Outcome& outcome,
                    const Arguments& arguments) {
  if (outcome.violation.empty()) return;
  std::printf("%s  VIOLATION at %s\n%s  again: ./dev chaos 1 %" PRIu64 "%s\n", schedule.c_str(),
              outcome.violation.c_str(), outcome.story.c_str(), seed,
              arguments.through_doors ? " --doors" : "");
  std::fflush(stdout);
}

Outcome played_and_told(std::uint64_t seed, const Arguments& arguments) {
  if (is_for_a_door(seed, arguments)) {
    const DoorSchedule schedule = drawn_door_schedule(seed);
    const auto start = std::chrono::steady_clock::now();
    if (arguments.tells_all) std::fprintf(stderr, "%s", told(schedule).c_str());
    const Outcome outcome = played_through_a_door(schedule);
    if (arguments.tells_all) {
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      std::fprintf(stderr, "%s  %.1f s, force for %d ms%s\n", outcome.story.c_str(),
                   took.count(), outcome.num_milliseconds_with_force,
                   outcome.was_played ? "" : ", left out");
    }
    tell_violation(told(schedule), seed, outcome, arguments);
    return outcome;
  }
  const Schedule schedule = drawn_schedule(seed);
  const Outcome outcome = played(schedule, arguments);
  if (arguments.measures_energy) {
    std::printf("ENERGY %g kg %d ms %g J\n", schedule.hand_mass_kg, schedule.most_late_ms(),
                outcome.most_given_j);
  }
  tell_violation(told(schedule), seed, outcome, arguments);
  return outcome;
}

void count(const Outcome& outcome, Counts& counts) {
  ++(outcome.was_played ? counts.num_played : counts.num_left_out);
  counts.num_failed += outcome.violation.empty() ? 0 : 1;
  counts.num_with_force += outcome.num_milliseconds_with_force > 0 ? 1 : 0;
}

/// Prints the totals. The last line has the form in which CTest reports its results.
void sum_up(const Counts& counts, const Arguments& arguments, double took_s) {
  std::printf("chaos: %" PRIu64 " schedules from seed %" PRIu64 " on in %.1f s, %" PRIu64
              " of them with force; %" PRIu64 " left out\n",
              counts.num_played, arguments.first_seed, took_s, counts.num_with_force,
              counts.num_left_out);
  const double passed_percent =
      counts.num_played == 0
          ? 100.0
          : 100.0 * static_cast<double>(counts.num_played - counts.num_failed) /
                static_cast<double>(counts.num_played);
  // The percentage is rounded down, so that it is 100 only if all passed.
  std::printf("%.0f%% tests passed, %" PRIu64 " tests failed out of %" PRIu64 "\n",
              std::floor(passed_percent), counts.num_failed, counts.num_played);
}

/// Plays devices that are wrong on purpose. The judge that calls the others sound must find
/// each of them.
int campaign_of_wrong_devices(const Arguments& arguments) {
  int num_missed = 0;
  for (std::uint64_t i = 0; i < arguments.num_schedules; ++i) {
    const DoorSchedule schedule = wrong_door_schedule(arguments.first_seed + i);
    const Outcome outcome = played_through_a_door(schedule);
    const bool is_missed = outcome.was_played && outcome.violation.empty();
    num_missed += is_missed ? 1 : 0;
    std::printf("%s  %s%s\n", told(schedule).c_str(),
                is_missed            ? "MISSED"
                : outcome.was_played ? "found: "
                                     : "left out",
                outcome.violation.c_str());
    std::fflush(stdout);
  }
  return num_missed == 0 ? 0 : 1;
}

int campaign(const Arguments& arguments) {
  constexpr std::uint64_t kTellEvery = 250;
  const auto start = std::chrono::steady_clock::now();
  Counts counts;
  for (std::uint64_t i = 0; i < arguments.num_schedules; ++i) {
    count(played_and_told(arguments.first_seed + i, arguments), counts);
    if (counts.num_failed > 0 && arguments.ends_at_first) break;
    if ((i + 1) % kTellEvery == 0) {
      std::fprintf(stderr,
                   "chaos: %" PRIu64 " of %" PRIu64 " schedules, %" PRIu64 " violations\n",
                   i + 1, arguments.num_schedules, counts.num_failed);
    }
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  sum_up(counts, arguments, took.count());
  return counts.num_failed == 0 ? 0 : 1;
}

}  // namespace

int main(int num, char** words) {
  const auto arguments = read_arguments(num, words);
  if (!arguments) {
    std::fputs(
        "jnd_chaos: expected [SCHEDULES] [SEED] [--virtual-time] [--first] [--energy] "
        "[--doors] "
        "[--wrong-devices] [--tell], found other words\n",
        stderr);
    return 2;
  }
  return arguments->wrong_devices ? campaign_of_wrong_devices(*arguments)
                                  : campaign(*arguments);
}
