#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace jnd::soak {

/// What a process holds after a round.
struct ProcessUse {
  /// Bytes in use by `malloc`, in every arena; 0 for another process.
  double allocated_bytes = 0.0;
  double resident_bytes = 0.0;  ///< Bytes in memory, the free parts of the arenas included.
  int num_handles = 0;          ///< Open files, sockets and pipes.
  int num_threads = 0;
};

/// What this process holds.
[[nodiscard]] ProcessUse process_use();
/// What another process holds, as the system sees it from outside; zeros if there is none.
[[nodiscard]] ProcessUse use_of(pid_t process);

/// What `look` sees after a round, once what is just ending has ended: looks again for at most
/// half a second while there are more threads or handles than after the round before.
[[nodiscard]] ProcessUse settled(const std::function<ProcessUse()>& look,
                                 const std::vector<ProcessUse>& rounds);

/// The largest relative growth of a quantity from the rounds after the warm-up to the last ones
/// that counts as none.
constexpr double kMostGrowth = 0.03;

/// Says what has grown, one sentence each; empty if nothing has. The first quarter of the
/// rounds is warm-up. `judges_resident` says whether there were enough rounds for the arenas to
/// have found their size.
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
