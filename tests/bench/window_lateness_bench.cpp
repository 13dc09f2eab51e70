#include <benchmark/benchmark.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/tiny_study.h"
#include "app/window/window_studies.h"
#include "bench/measured_window.h"
#include "core/storage/study_store.h"
#include "support/program.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// Returns a study with one medium, which the simulated hand feels for this time.
std::string study_of_one_medium(int seconds) {
  return study_of(R"json({
    "kind": "explore", "name": "feel", "instruction": {"en": "Move."},
    "media": [{"medium": "viscous", "viscosity_pa_s": 8, "duration_s": )json" +
                  std::to_string(seconds) + "}]}");
}

struct StoredLateness {
  double p50_us = 0.0, p99_us = 0.0, p999_us = 0.0;
  double missed_ticks = 0.0;
};

/// Returns the lateness of the whole session, as the study stores it.
StoredLateness stored_lateness(const fs::path& study) {
  const core::StudyStore store(study, core::StudyStore::Mode::kReadOnly);
  std::optional<nlohmann::json> measured;
  for (const core::EventRow& event : store.events(1)) {
    const auto data = nlohmann::json::parse(event.data, nullptr, false);
    if (event.kind == "loop_started" && data.at("scheduler") != "SCHED_FIFO 80") {
      throw std::runtime_error("the right to SCHED_FIFO is missing: see jnd doctor");
    }
    if (event.kind == "loop_measured") measured = data;
  }
  if (!measured) throw std::runtime_error("the session says nothing of its loop");
  const double total = measured->at("num_ticks");
  const auto at_us = [&](double ratio) {
    double seen = 0.0;
    double up_to_ns = 0.0;
    for (const auto& bucket : measured->at("lateness_ns")) {
      up_to_ns = bucket.at(0);
      seen += bucket.at(1).get<double>();
      if (seen >= ratio * total) break;
    }
    return 1e-3 * up_to_ns;
  };
  return {at_us(0.5), at_us(0.99), at_us(0.999), measured->at("missed_ticks")};
}

StoredLateness without_window(int seconds) {
  const test_support::TemporaryFolder folder(test_support::memory_folder());
  write_file(folder.path() / "study.json", study_of_one_medium(seconds));
  const test_support::ProgramOutcome outcome =
      test_support::run_program({"run", "study.json", "--study", "a.study", "--participant",
                                 "P01", "--headless", "--realtime"},
                                {.folder = folder.path()});
  if (outcome.exit_code != 0) throw std::runtime_error("jnd run: " + outcome.err);
  return stored_lateness(folder.path() / "a.study");
}

/// Runs the session with the window, which draws thirty frames a second with live plots.
StoredLateness with_window(int seconds) {
  MeasuredWindow window(false);
  write_file(window.path("study.json"), study_of_one_medium(seconds));
  WindowDriver& person = window.person();
  person.start({"run", window.path("study.json").string(), "--study",
                window.path("a.study").string(), "--participant", "P01", "--device", "lumped"});
  person.use("start_session");
  person.use("begin");
  person.use("feel_medium");
  sleep_s(seconds);
  person.use("finish_medium");
  person.wait_for_text("Session finished");
  person.kill();
  return stored_lateness(window.path("a.study"));
}

int session_seconds() {
  const char* text = std::getenv("JND_BENCH_SECONDS");
  return std::max(text == nullptr ? 20 : std::atoi(text), 1);
}

/// Measures a real-time session with the simulated hand, by turns with the window and without
/// it, in three rounds of JND_BENCH_SECONDS (default 20) each. The time is from when a tick was
/// due until its force was written. It prints the medians of the rounds and their ratios.
void loop_beside_window(benchmark::State& state) {
  constexpr int kNumRounds = 3;
  const int seconds = session_seconds();
  std::vector<StoredLateness> with, without;
  measure(state, [&] {
    for (int round = 0; round < kNumRounds; ++round) {
      without.push_back(without_window(seconds));
      with.push_back(with_window(seconds));
    }
    const auto tell = [&](const std::string& name, double StoredLateness::*percentile_us) {
      std::vector<double> ours, theirs;
      for (const StoredLateness& run : with) ours.push_back(run.*percentile_us);
      for (const StoredLateness& run : without) theirs.push_back(run.*percentile_us);
      state.counters["with_" + name + "_us"] = median(ours);
      state.counters["without_" + name + "_us"] = median(theirs);
      state.counters["ratio_" + name] = median(ours) / median(theirs);
    };
    tell("p50", &StoredLateness::p50_us);
    tell("p99", &StoredLateness::p99_us);
    tell("p999", &StoredLateness::p999_us);
    double missed = 0.0;
    for (const StoredLateness& run : with) missed += run.missed_ticks;
    state.counters["missed_ticks"] = missed;
    state.counters["session_seconds"] = seconds;
  });
}
BENCHMARK(loop_beside_window)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
}  // namespace jnd::app
