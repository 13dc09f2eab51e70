#include <benchmark/benchmark.h>

#include <filesystem>
#include <stdexcept>

#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd {
namespace {

/// Measures `jnd report` on a demo study of 13 participants with every figure and, if there is
/// a browser, the PDF. The goal is less than 10 s.
void report_of_demo_study(benchmark::State& state, const char* study) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const test_support::ProgramOptions options{.folder = temporary.path(), .environment = {}};
  if (test_support::run_program({"demo", "--fast", "--out", "demo"}, options).exit_code != 0) {
    throw std::runtime_error("jnd demo failed");
  }
  const std::string folder = std::string("demo/") + study + ".study";
  for (auto _ : state) {
    const auto outcome =
        test_support::run_program({"report", folder, "--out", "report"}, options);
    if (outcome.exit_code != 0) throw std::runtime_error(outcome.err);
    state.PauseTiming();
    std::filesystem::remove_all(temporary.path() / "report");
    state.ResumeTiming();
  }
}

BENCHMARK_CAPTURE(report_of_demo_study, magnitude, "magnitude_of_virtual_water")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(report_of_demo_study, discrimination, "viscosity_discrimination")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace jnd
