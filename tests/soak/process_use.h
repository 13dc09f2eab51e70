#pragma once

#include <sys/types.h>

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace jnd::soak {

/// What a process holds, after a round.
struct ProcessUse {
  double allocated_bytes = 0.0;  ///< By `malloc`, in use, in every arena; 0 of another process.
  double resident_bytes = 0.0;   ///< In memory, free parts of the arenas among it.
  int num_handles = 0;           ///< Open files, sockets and pipes.
  int num_threads = 0;
};

/// Of this process.
[[nodiscard]] ProcessUse process_use();
/// Of another one, as the system sees it from outside; zeros where there is none.
[[nodiscard]] ProcessUse use_of(pid_t process);

/// The most that a quantity may have grown by from the rounds after the warm-up to the last.
constexpr double kMostGrowth = 0.03;

/// What has grown, one sentence each; none where all is as it was. The first quarter of the
/// rounds is warm-up. `judges_resident`: whether there were rounds enough for the arenas to
/// have found their size.
[[nodiscard]] std::vector<std::string> growths(const std::vector<ProcessUse>& rounds,
                                               bool judges_resident);

/// Median of one quantity over the rounds right after the warm-up, and over the last ones.
struct BeforeAndAfter {
  double before = 0.0, after = 0.0;

  [[nodiscard]] double growth() const { return before > 0.0 ? after / before - 1.0 : 0.0; }
};
[[nodiscard]] BeforeAndAfter compared(const std::vector<double>& rounds);

/// The same as JSON: each quantity after the warm-up, at the end, and by round.
[[nodiscard]] nlohmann::json told_of(const std::vector<ProcessUse>& rounds);

[[nodiscard]] double median(std::vector<double> values);

}  // namespace jnd::soak
