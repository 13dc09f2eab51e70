#include <charconv>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>

#include "chaos/worlds.h"

// The campaign: random schedules of everything at once. `./dev chaos` runs it.

namespace {

using namespace jnd::chaos;

struct Arguments {
  std::uint64_t num_schedules = 1000;
  std::uint64_t first_seed = 1;
  bool in_virtual_time = false;  ///< Without the real program.
  bool ends_at_first = false;    ///< At the first violation.
  bool measures_energy = false;  ///< A line a schedule, for whoever derives the bound.
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
    if (word == "--virtual-time" || word == "--first" || word == "--energy") {
      arguments.in_virtual_time |= word == "--virtual-time";
      arguments.ends_at_first |= word == "--first";
      arguments.measures_energy |= word == "--energy";
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

void tell(const Schedule& schedule, const Outcome& outcome, const Arguments& arguments) {
  if (arguments.measures_energy) {
    std::printf("ENERGY %g kg %d ms %g J\n", schedule.hand_mass_kg, schedule.most_late_ms(),
                outcome.most_given_j);
  }
  if (outcome.violation.empty()) return;
  std::printf("%s  VIOLATION at %s\n  again: ./dev chaos 1 %" PRIu64 "\n",
              told(schedule).c_str(), outcome.violation.c_str(), schedule.seed);
  std::fflush(stdout);
}

void count(const Outcome& outcome, Counts& counts) {
  ++(outcome.was_played ? counts.num_played : counts.num_left_out);
  counts.num_failed += outcome.violation.empty() ? 0 : 1;
  counts.num_with_force += outcome.num_milliseconds_with_force > 0 ? 1 : 0;
}

/// The last line is one that whoever reads a test run's output knows.
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
  // Not rounded up to all of them.
  std::printf("%.0f%% tests passed, %" PRIu64 " tests failed out of %" PRIu64 "\n",
              std::floor(passed_percent), counts.num_failed, counts.num_played);
}

int campaign(const Arguments& arguments) {
  constexpr std::uint64_t kTellEvery = 250;
  const auto start = std::chrono::steady_clock::now();
  Counts counts;
  for (std::uint64_t i = 0; i < arguments.num_schedules; ++i) {
    const Schedule schedule = drawn_schedule(arguments.first_seed + i);
    const Outcome outcome = played(schedule, arguments);
    count(outcome, counts);
    tell(schedule, outcome, arguments);
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
        "jnd_chaos: expected [SCHEDULES] [SEED] [--virtual-time] [--first] [--energy], "
        "found other words\n",
        stderr);
    return 2;
  }
  return campaign(*arguments);
}
