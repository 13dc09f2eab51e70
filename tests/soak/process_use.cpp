#include "soak/process_use.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

namespace jnd::soak {

namespace fs = std::filesystem;

static int num_entries(const fs::path& folder) {
  std::error_code gone;
  const fs::directory_iterator entries(folder, gone);
  return gone ? 0 : static_cast<int>(std::distance(begin(entries), end(entries)));
}

static ProcessUse seen_in(const fs::path& process) {
  ProcessUse use{.num_handles = num_entries(process / "fd"),
                 .num_threads = num_entries(process / "task")};
  double total_pages = 0.0, resident_pages = 0.0;
  std::ifstream(process / "statm") >> total_pages >> resident_pages;
  use.resident_bytes = resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return use;
}

ProcessUse use_of(pid_t process) { return seen_in("/proc/" + std::to_string(process)); }

ProcessUse process_use() {
  ProcessUse use = seen_in("/proc/self");
  // While the folder that lists the handles is read, it is a handle itself.
  --use.num_handles;
  const struct mallinfo2 heap = ::mallinfo2();
  use.allocated_bytes = static_cast<double>(heap.uordblks + heap.hblkhd);
  return use;
}

ProcessUse settled(const std::function<ProcessUse()>& look,
                   const std::vector<ProcessUse>& rounds) {
  ProcessUse use = look();
  for (int i = 0; i < 10 && !rounds.empty(); ++i) {
    if (use.num_threads <= rounds.back().num_threads &&
        use.num_handles <= rounds.back().num_handles) {
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    use = look();
  }
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

nlohmann::json told_of(const std::vector<ProcessUse>& rounds) {
  nlohmann::json told;
  const auto tell = [&](const std::string& quantity, auto value) {
    std::vector<double> values;
    for (const ProcessUse& round : rounds) values.push_back(value(round));
    const BeforeAndAfter change = compared(values);
    told[quantity] = {{"after_warm_up", change.before},
                      {"at_end", change.after},
                      {"growth_ratio", change.growth()},
                      {"by_round", values}};
  };
  tell("allocated_bytes", [](const ProcessUse& use) { return use.allocated_bytes; });
  tell("resident_bytes", [](const ProcessUse& use) { return use.resident_bytes; });
  tell("handles", [](const ProcessUse& use) { return 1.0 * use.num_handles; });
  tell("threads", [](const ProcessUse& use) { return 1.0 * use.num_threads; });
  return told;
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
