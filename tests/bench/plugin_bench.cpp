#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "core/clock.h"
#include "device/plugin/plugin_device.h"
#include "device/realtime_report.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd {
namespace {

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * core::kNsPerS + now.tv_nsec;
}

void sleep_until(std::int64_t due_ns) {
  const timespec due{.tv_sec = static_cast<time_t>(due_ns / core::kNsPerS),
                     .tv_nsec = static_cast<long>(due_ns % core::kNsPerS)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) != 0) {
  }
}

/// Measures a read and a write of the example driver, at 1 kHz by the clock. If the driver has
/// a process of its own, the loop's measurement and force come later by this time.
void plugin_exchange(benchmark::State& state) {
  const bool in_process = state.range(0) == 0;
  constexpr int kNumTicks = 5000;
  constexpr std::int64_t kPeriod_ns = 1'000'000;
  const test_support::TemporaryFolder folder;
  const std::string driver = (folder.path() / "example.so").string();
  const std::string source = (test_support::source_folder() / "device" / "plugin").string();
  const std::string build = "cc -O2 -std=c11 -shared -fPIC -I '" + source + "' '" + source +
                            "/example_device.c' -o '" + driver + "'";
  if (std::system(build.c_str()) != 0) return state.SkipWithError("no C compiler");
  ::setenv("JND_DEVICE_HOST", test_support::device_host_file().c_str(), 1);
  const std::unique_ptr<device::HapticDevice> hand = device::make_plugin_device(
      driver + (in_process ? ":simulated,in-process" : ":simulated"), 1000.0);
  device::RealtimeReport report;
  device::obtain_scheduler(80, report);
  hand->open();
  std::vector<double> taken_us;
  for (auto _ : state) {
    std::int64_t due_ns = now_ns();
    for (int i = 0; i < kNumTicks; ++i) {
      sleep_until(due_ns += kPeriod_ns);
      const std::int64_t begin_ns = now_ns();
      core::HapticState measured;
      benchmark::DoNotOptimize(hand->read(measured));
      benchmark::DoNotOptimize(hand->write(core::zero_vectors()));
      taken_us.push_back(1e-3 * static_cast<double>(now_ns() - begin_ns));
    }
  }
  hand->close();
  std::sort(taken_us.begin(), taken_us.end());
  const auto percentile = [&](double ratio) {
    return taken_us[static_cast<std::size_t>(ratio * static_cast<double>(taken_us.size() - 1))];
  };
  state.counters["p50_us"] = percentile(0.50);
  state.counters["p99_us"] = percentile(0.99);
  state.counters["max_us"] = taken_us.back();
  state.SetLabel((in_process ? "in this process, " : "in a process of its own, ") +
                 report.scheduler);
}
BENCHMARK(plugin_exchange)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace jnd
