#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "experiments/protocol/schema_writer.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::experiments {
namespace {

constexpr int kNumLines = 1000;

/// Returns a study of 1000 lines as an author indents it, in two languages. If `broken`, each
/// block has a misspelt key.
std::string study_of_lines(bool broken) {
  std::string text = R"({
  "$schema": "./study.schema.json",
  "format": 1,
  "name": "long",
  "languages": ["en", "de"],
  "title": {"en": "Long", "de": "Lang"},
  "authors": ["A. Author"],
  "stages": [)";
  for (int block = 0; std::count(text.begin(), text.end(), '\n') < kNumLines - 20; ++block) {
    text += block == 0 ? "\n" : ",\n";
    text += R"(    {
      "kind": "block",
      "name": "block_)" +
            std::to_string(block) + R"(",
      "title": {"en": "Comparison", "de": "Vergleich"},
      "procedure": "constant_stimuli",
      "medium": "viscous",
      "viscosity_pa_s": [10, 12, 14, 18, 20, 24],
      "reference_viscosity_pa_s": 16,
      ")" + (broken ? "repetitons" : "repetitions") +
            R"(": 3,
      "instruction": {
        "en": "First comes the reference, then the test. You may go back and forth.",
        "de": "Zuerst kommt der Vergleichsreiz, dann der Test. Sie dürfen wechseln."
      },
      "question": {"en": "Does it feel thicker?", "de": "Fühlt es sich dicker an?"},
      "free_space_between_s": 2,
      "expected_trial_s": 15
    })";
  }
  return text + "\n  ]\n}\n";
}

/// Measures what `jnd validate` does with a file that has been read. The goal is 20 ms.
void validate_study_of_1000_lines(benchmark::State& state) {
  const bool broken = state.range(0) == 1;
  const std::string text = study_of_lines(broken);
  std::size_t num_problems = 0;
  for (auto _ : state) {
    num_problems = study_text_problems(text, "long.json").size();
    benchmark::DoNotOptimize(num_problems);
  }
  if (broken == (num_problems == 0)) state.SkipWithError("the study is not what it should be");
  state.counters["lines"] = static_cast<double>(std::count(text.begin(), text.end(), '\n'));
  state.counters["problems"] = static_cast<double>(num_problems);
}
BENCHMARK(validate_study_of_1000_lines)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// Measures the same and the making of a study, as in every command that takes one.
void read_study_of_1000_lines(benchmark::State& state) {
  const std::string text = study_of_lines(false);
  for (auto _ : state) {
    const Study study = read_study_text(text, "long.json");
    benchmark::DoNotOptimize(study.stages.size());
  }
}
BENCHMARK(read_study_of_1000_lines)->Unit(benchmark::kMillisecond);

/// Measures the largest list that the reader accepts: 4 MiB of numbers. The time has to be
/// bounded, not short.
void refuse_four_mebibytes_of_numbers(benchmark::State& state) {
  std::string text = "{\"stages\": [0";
  while (text.size() < (std::size_t{4} << 20) - 10) text += ",0";
  text += "]}";
  for (auto _ : state) {
    if (study_text_problems(text, "x.json").empty()) state.SkipWithError("not refused");
  }
}
BENCHMARK(refuse_four_mebibytes_of_numbers)->Unit(benchmark::kMillisecond);

/// Measures as many unknown keys as fit into a file.
void refuse_four_mebibytes_of_keys(benchmark::State& state) {
  std::string text = "{\"format\": 1";
  for (int i = 0; text.size() < (std::size_t{4} << 20) - 40; ++i) {
    text += ",\"k" + std::to_string(i) + "\":0";
  }
  text += '}';
  for (auto _ : state) {
    if (study_text_problems(text, "x.json").empty()) state.SkipWithError("not refused");
  }
}
BENCHMARK(refuse_four_mebibytes_of_keys)->Unit(benchmark::kMillisecond);

void write_schema(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(study_schema().size());
}
BENCHMARK(write_schema)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::experiments
