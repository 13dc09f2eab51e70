#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "app/environment.h"
#include "app/operator/simulated_study.h"
#include "soak/person.h"
#include "soak/process_use.h"
#include "support/temporary_folder.h"

// Plays a day of work in minutes: everything in the window, again and again, by a clock that
// goes on by a thirtieth of a second with each frame. Whatever grows is a leak. Exit code 0:
// nothing has grown; 1: something has, or a view was never seen; 2: wrong usage.

namespace jnd::soak {
namespace {

/// Soaks of at least this many hours are judged in full. In shorter ones the arenas of the C
/// library have not yet found their size, and each look is brief.
constexpr double kHoursOfALongSoak = 2.0;
constexpr double kLook_s = 6.0, kGlance_s = 0.4;
/// The most that the median frame time of the last eighth may be, relative to the second
/// eighth.
constexpr double kMostSlowing = 1.2;
constexpr std::size_t kFramesToJudgeAView = 500;
constexpr std::size_t kFewestRounds = 8;
constexpr std::size_t kLeftBehindEachRound_bytes = 1'000'000;

struct Options {
  double hours = 8.0;
  /// Leaves memory or handles behind in each round, as a proof that a soak sees them.
  bool leaks_memory = false, leaks_handles = false;
  bool tells = false;
};

Options options_of(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--tell") {
      options.tells = true;
      continue;
    }
    if (word == "--leak" && i + 1 < argc) {
      const std::string leak = argv[++i];
      options.leaks_memory = options.leaks_memory || leak == "memory";
      options.leaks_handles = options.leaks_handles || leak == "handles";
      if (leak == "memory" || leak == "handles") continue;
    } else {
      char* end = nullptr;
      options.hours = std::strtod(word.c_str(), &end);
      if (*end == '\0' && options.hours > 0.0 && options.hours < 1000.0) continue;
    }
    throw std::runtime_error("expected [HOURS] [--leak memory|handles] [--tell], found `" +
                             word + "`");
  }
  return options;
}

void leave_behind(const Options& options) {
  // This is volatile, so that no compiler leaves the allocation out because nobody reads it.
  static char* volatile lost = nullptr;
  if (options.leaks_memory) {
    for (std::size_t bytes = 0; bytes < kLeftBehindEachRound_bytes; bytes += 1000) {
      lost = static_cast<char*>(std::malloc(1000));
      *lost = 'x';
    }
  }
  if (options.leaks_handles) (void)::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

/// The median over the views of the ratio of the last frame times to the first ones after the
/// warm-up. Only views with enough frames count.
double slowing(const Person& person) {
  std::vector<double> ratios;
  for (const auto& [view, times] : person.frames()) {
    if (times.num_compared() < kFramesToJudgeAView) continue;
    ratios.push_back(times.at_last_s() / times.at_first_s());
  }
  return ratios.empty() ? 1.0 : median(ratios);
}

bool is_machine_busy() {
  double load = 0.0;
  return ::getloadavg(&load, 1) != 1 ||
         load > 1.5 * static_cast<double>(std::thread::hardware_concurrency());
}

int soak(const Options& options) {
  const test_support::TemporaryFolder folder(test_support::memory_folder());
  const app::EnvironmentVariable state("XDG_STATE_HOME", folder.path().c_str());
  const app::EnvironmentVariable config("XDG_CONFIG_HOME", folder.path().c_str());
  const app::EnvironmentVariable data("XDG_DATA_HOME", folder.path().c_str());
  const bool is_long = options.hours >= kHoursOfALongSoak;
  app::SimulatedStudy made;
  made.simulate(2, /*record=*/true);
  (void)made.interrupt(3);
  // The copies look for the study's file beside them.
  app::write_file(folder.path() / "tiny.json", app::kTinyStudy);
  Person person({.template_study = made.folder(),
                 .table = app::write_file(folder.path() / "order.csv",
                                          "condition,delay,yes,n\nlight,-90,2,40\n"
                                          "light,-30,12,40\nlight,0,20,40\nlight,30,30,40\n"
                                          "sound,-90,1,40\nsound,-30,5,40\nsound,0,12,40\n"
                                          "sound,30,22,40\nsound,90,37,40\n"),
                 .folder = folder.path(),
                 .duration_s = 3600.0 * options.hours,
                 .look_s = is_long ? kLook_s : kGlance_s,
                 .tells = options.tells});
  const auto begin = std::chrono::steady_clock::now();
  std::vector<ProcessUse> rounds;
  while (person.now_s() < 3600.0 * options.hours || rounds.size() < kFewestRounds) {
    person.go_round();
    leave_behind(options);
    rounds.push_back(settled(process_use, rounds));
    if (::testing::UnitTest::GetInstance()->ad_hoc_test_result().Failed()) break;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::vector<std::string> problems = growths(rounds, is_long);
  for (const std::string& missed : person.missed()) problems.push_back("not seen: " + missed);
  const double slower = slowing(person);
  const bool is_busy = is_machine_busy();
  if (is_long && !is_busy && slower > kMostSlowing) {
    problems.push_back("frames: expected those of the last eighth as fast as at first, found " +
                       std::to_string(slower) + " times its time");
  }
  if (::testing::UnitTest::GetInstance()->ad_hoc_test_result().Failed()) {
    problems.emplace_back(
        "a view: expected every widget once and each key for one of them; "
        "see what is told above");
  }
  nlohmann::json told = {{"simulated_hours", person.now_s() / 3600.0},
                         {"simulated_hours_in_sessions", person.in_sessions_s() / 3600.0},
                         {"seconds", took.count()},
                         {"rounds", rounds.size()},
                         {"sessions", person.num_sessions()},
                         {"frames", person.num_frames()},
                         {"machine_is_busy", is_busy},
                         {"held", told_of(rounds)},
                         {"problems", problems}};
  // In a short soak the first frames of a view show something else than its last ones.
  if (is_long) told["frame_slowing_ratio"] = slower;
  for (const auto& [view, times] : person.frames()) {
    told["views"][view] = {{"frames", times.num()},
                           {"median_at_first_ms", 1e3 * times.at_first_s()},
                           {"median_at_last_ms", 1e3 * times.at_last_s()}};
  }
  std::printf("%s\n", told.dump(1).c_str());
  return problems.empty() ? 0 : 1;
}

}  // namespace
}  // namespace jnd::soak

int main(int argc, char** argv) {
  // The expectations of the frames report widgets that are drawn twice.
  int no_arguments = 1;
  ::testing::InitGoogleTest(&no_arguments, argv);
  try {
    return jnd::soak::soak(jnd::soak::options_of(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "jnd_soak: %s\n", error.what());
    return 2;
  }
}
