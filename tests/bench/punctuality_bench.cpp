#include <benchmark/benchmark.h>
#include <stdio.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "support/places.h"

namespace jnd {
namespace {

/// How late events at 1 kHz came, in microseconds.
struct Lateness {
  double p50_us = 0.0;
  double p99_us = 0.0;
  double p999_us = 0.0;
};

/// Returns what a command printed, or nothing if it failed.
std::optional<std::string> output_of(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> bytes;
  for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) {
    text.append(bytes.data(), count);
  }
  if (::pclose(pipe) != 0) return std::nullopt;
  return text;
}

/// Returns the smallest bucket, of 1 us, that at least `ratio` of all values do not exceed.
double percentile_us(const std::vector<std::pair<double, double>>& histogram, double ratio) {
  double total = 0.0;
  for (const auto& [us, count] : histogram) total += count;
  double seen = 0.0;
  for (const auto& [us, count] : histogram) {
    seen += count;
    if (seen >= ratio * total) return us;
  }
  return histogram.empty() ? 0.0 : histogram.back().first;
}

std::optional<Lateness> run_cyclictest(int seconds) {
  constexpr int kHistogramUs = 20'000;
  const auto text = output_of("cyclictest -m -p80 -i1000 -q -D " + std::to_string(seconds) +
                              " --histogram " + std::to_string(kHistogramUs));
  if (!text) return std::nullopt;
  std::vector<std::pair<double, double>> histogram;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    // Lines are "000020 004711". Comments begin with #, and one of them counts the values
    // beyond the histogram.
    if (line.rfind("# Histogram Overflows:", 0) == 0) {
      histogram.emplace_back(kHistogramUs, std::strtod(line.c_str() + 22, nullptr));
    }
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;
    double us = 0.0;
    double count = 0.0;
    if (std::istringstream(line) >> us >> count) histogram.emplace_back(us, count);
  }
  if (histogram.empty()) return std::nullopt;
  return Lateness{percentile_us(histogram, 0.5), percentile_us(histogram, 0.99),
                  percentile_us(histogram, 0.999)};
}

struct LoopRun {
  Lateness lateness;
  std::string scheduler;
  double missed_ticks = 0.0;
  double cpu_time_ratio = 0.0;
};

std::optional<LoopRun> run_loop(int seconds) {
  const auto text =
      output_of("'" + test_support::program_file().string() +
                "' loop --rate-hz 1000 --json --seconds " + std::to_string(seconds));
  if (!text) return std::nullopt;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  const auto& us = json.at("lateness_us");
  return LoopRun{{us.at("p50"), us.at("p99"), us.at("p999")},
                 json.at("scheduler"),
                 json.at("missed_ticks"),
                 json.at("cpu_time_ratio")};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

int seconds_a_round() {
  const char* text = std::getenv("JND_BENCH_SECONDS");
  const int seconds = text == nullptr ? 20 : std::atoi(text);
  return std::max(seconds, 1);
}

/// Compares the loop with cyclictest, alternating, in three rounds of JND_BENCH_SECONDS
/// (default 20): from when a tick was due until its force was written, and until the thread
/// merely ran. Reports medians of the rounds, in microseconds, and their ratios. Any other
/// program affects both.
void loop_against_cyclictest(benchmark::State& state) {
  constexpr int kNumRounds = 3;
  const int seconds = seconds_a_round();
  std::vector<LoopRun> loops;
  std::vector<Lateness> references;
  for (auto _ : state) {
    for (int round = 0; round < kNumRounds; ++round) {
      const auto reference = run_cyclictest(seconds);
      if (!reference) {
        state.SkipWithError(
            "cyclictest (package rt-tests) is missing or was refused SCHED_FIFO");
        return;
      }
      const auto loop = run_loop(seconds);
      if (!loop) {
        state.SkipWithError("jnd loop failed");
        return;
      }
      if (loop->scheduler != "SCHED_FIFO 80") {
        state.SkipWithError("the right to SCHED_FIFO is missing: see jnd doctor");
        return;
      }
      references.push_back(*reference);
      loops.push_back(*loop);
    }
  }
  const auto tell = [&](const std::string& name, double Lateness::*percentile) {
    std::vector<double> ours;
    std::vector<double> theirs;
    for (const LoopRun& run : loops) ours.push_back(run.lateness.*percentile);
    for (const Lateness& run : references) theirs.push_back(run.*percentile);
    state.counters["loop_" + name + "_us"] = median(ours);
    state.counters["cyclictest_" + name + "_us"] = median(theirs);
    state.counters["ratio_" + name] = median(ours) / median(theirs);
  };
  tell("p50", &Lateness::p50_us);
  tell("p99", &Lateness::p99_us);
  tell("p999", &Lateness::p999_us);
  double missed = 0.0;
  std::vector<double> cpu;
  for (const LoopRun& run : loops) {
    missed += run.missed_ticks;
    cpu.push_back(run.cpu_time_ratio);
  }
  state.counters["missed_ticks"] = missed;
  state.counters["cpu_time_ratio"] = median(cpu);
  state.counters["seconds_a_round"] = seconds;
}
BENCHMARK(loop_against_cyclictest)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
}  // namespace jnd
