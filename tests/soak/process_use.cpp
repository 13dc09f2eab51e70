#include "soak/process_use.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace jnd::soak {

namespace fs = std::filesystem;

/// The folder that lists handles is a handle itself while it is read.
constexpr int kHandleOfTheLook = 1;

static int num_entries(const fs::path& folder) {
  return static_cast<int>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

ProcessUse process_use() {
  const struct mallinfo2 heap = ::mallinfo2();
  ProcessUse use{.allocated_bytes = static_cast<double>(heap.uordblks + heap.hblkhd),
                 .num_handles = num_entries("/proc/self/fd") - kHandleOfTheLook,
                 .num_threads = num_entries("/proc/self/task")};
  double total_pages = 0.0, resident_pages = 0.0;
  std::ifstream("/proc/self/statm") >> total_pages >> resident_pages;
  use.resident_bytes = resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return use;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

BeforeAndAfter compared(const std::vector<double>& rounds) {
  const auto num_rounds = static_cast<std::ptrdiff_t>(rounds.size());
  const std::ptrdiff_t warm_up = (num_rounds + 3) / 4;
  const std::ptrdiff_t compared_rounds =
      std::max<std::ptrdiff_t>(1, (num_rounds - warm_up) / 8);
  if (num_rounds < warm_up + 2 * compared_rounds) return {1.0, 1.0};
  const auto first = rounds.begin() + warm_up;
  return {median({first, first + compared_rounds}),
          median({rounds.end() - compared_rounds, rounds.end()})};
}

std::vector<std::string> growths(const std::vector<ProcessUse>& rounds, bool judges_resident) {
  std::vector<std::string> found;
  const auto judge = [&](const std::string& what, double most, auto quantity) {
    std::vector<double> values;
    for (const ProcessUse& round : rounds) values.push_back(quantity(round));
    const BeforeAndAfter change = compared(values);
    if (change.growth() <= most) return;
    found.push_back(what + ": expected the same at the end as after the warm-up, found " +
                    std::to_string(static_cast<long long>(change.after)) + " instead of " +
                    std::to_string(static_cast<long long>(change.before)));
  };
  judge("bytes allocated", kMostGrowth,
        [](const ProcessUse& use) { return use.allocated_bytes; });
  if (judges_resident) {
    judge("bytes in memory", kMostGrowth,
          [](const ProcessUse& use) { return use.resident_bytes; });
  }
  judge("open handles", 0.0, [](const ProcessUse& use) { return 1.0 * use.num_handles; });
  judge("threads", 0.0, [](const ProcessUse& use) { return 1.0 * use.num_threads; });
  return found;
}

}  // namespace jnd::soak
