#pragma once

#include <sys/types.h>

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace jnd::soak {

/// What a process holds after a round.
struct ProcessUse {
  /// The memory in use from `malloc` in every arena, or 0 for another process.
  double allocated_bytes = 0.0;
  /// The memory that is resident, including free parts of the arenas.
  double resident_bytes = 0.0;
  int num_handles = 0;  ///< The number of open files, sockets and pipes.
  int num_threads = 0;
};

/// Measures this process.
[[nodiscard]] ProcessUse process_use();
/// Measures another process, as the system sees it from outside. All values are 0 if there is
/// no such process.
[[nodiscard]] ProcessUse use_of(pid_t process);

/// The largest growth of a quantity from the rounds after the warm-up to the last rounds.
constexpr double kMostGrowth = 0.03;

/// Returns one sentence for each quantity that has grown. The first quarter of the rounds is
/// warm-up. `judges_resident` says whether there were enough rounds for the arenas to reach
/// their size.
[[nodiscard]] std::vector<std::string> growths(const std::vector<ProcessUse>& rounds,
                                               bool judges_resident);

/// The median of one quantity over the rounds right after the warm-up, and over the last ones.
struct BeforeAndAfter {
  double before = 0.0, after = 0.0;

  [[nodiscard]] double growth() const { return before > 0.0 ? after / before - 1.0 : 0.0; }
};
[[nodiscard]] BeforeAndAfter compared(const std::vector<double>& rounds);

/// Returns the same as JSON: each quantity after the warm-up, at the end, and in each round.
[[nodiscard]] nlohmann::json told_of(const std::vector<ProcessUse>& rounds);

[[nodiscard]] double median(std::vector<double> values);

}  // namespace jnd::soak
