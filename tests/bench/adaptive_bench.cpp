#include <benchmark/benchmark.h>

#include <cmath>

#include "experiments/adaptive/level_scale.h"
#include "experiments/adaptive/quest_plus.h"

namespace jnd::experiments {
namespace {

/// Returns a rule with 50 intensities and 50 x 25 x 4 = 5000 combinations of parameters.
QuestPlusRule large_rule() {
  const auto grid = [](double low, double high, int count) {
    return equally_spaced(LevelScale::kLogarithmic, low, high, count);
  };
  return {.model = weber_model({.pse = {grid(0.8, 4.0, 50)},
                                .weber_fraction = {grid(0.05, 2.0, 25)},
                                .lapse_rate = {{0.0, 0.02, 0.04, 0.06}}}),
          .intensities = grid(0.5, 6.0, 50),
          .max_trials = 60};
}

/// Draws random answers that favour high intensities.
std::vector<LevelAnswer> answers_of(const QuestPlus& quest, int num_answers) {
  core::RandomStream stream(1, "adaptive_bench");
  QuestPlusPosterior posterior = quest.prior();
  std::vector<LevelAnswer> answers;
  while (static_cast<int>(answers.size()) < num_answers) {
    const double level = quest.next_intensity(posterior, stream);
    answers.push_back({level, level * stream.uniform(0.7, 1.4) > 1.8});
    quest.bring_up_to_date(posterior, answers);
  }
  return answers;
}

/// Measures one more answer and the choice of the stimulus after it.
void quest_plus_next(benchmark::State& state) {
  const QuestPlus quest(large_rule());
  core::RandomStream stream(1, "adaptive_bench");
  const auto answers = answers_of(quest, 31);
  const QuestPlusPosterior before = quest.posterior({answers.begin(), answers.end() - 1});
  for (auto _ : state) {
    QuestPlusPosterior posterior = before;
    quest.bring_up_to_date(posterior, answers);
    benchmark::DoNotOptimize(quest.next_intensity(posterior, stream));
  }
}
BENCHMARK(quest_plus_next)->Unit(benchmark::kMicrosecond);

/// Measures the same as Watson (2017) writes it: the posterior after each possible answer, and
/// its entropy.
void quest_plus_next_naive(benchmark::State& state) {
  const QuestPlusRule rule = large_rule();
  const QuestPlus quest(rule);
  const auto answers = answers_of(quest, 31);
  const Eigen::VectorXd posterior = quest.posterior(answers).probability;
  std::vector<Eigen::VectorXd> likelihood;
  for (const double intensity : rule.intensities) {
    Eigen::VectorXd column(posterior.size());
    for (Eigen::Index row = 0; row < column.size(); ++row) {
      column[row] = rule.model.probability(true, intensity, quest.values_at(row));
    }
    likelihood.push_back(column);
  }
  for (auto _ : state) {
    double least = 1e300;
    for (const Eigen::VectorXd& yes : likelihood) {
      double expected = 0.0;
      for (const bool answer : {false, true}) {
        Eigen::VectorXd joint = answer
                                    ? posterior.cwiseProduct(yes).eval()
                                    : (posterior.array() * (1.0 - yes.array())).matrix().eval();
        const double evidence = joint.sum();
        for (Eigen::Index row = 0; row < joint.size(); ++row) {
          const double p = joint[row] / evidence;
          if (p > 0.0) expected -= evidence * p * std::log2(p);
        }
      }
      least = std::min(least, expected);
    }
    benchmark::DoNotOptimize(least);
  }
}
BENCHMARK(quest_plus_next_naive)->Unit(benchmark::kMicrosecond);

/// Measures a restart, which computes the posterior of sixty answers from the prior on.
void quest_plus_replay(benchmark::State& state) {
  const QuestPlus quest(large_rule());
  const auto answers = answers_of(quest, 60);
  for (auto _ : state) benchmark::DoNotOptimize(quest.posterior(answers));
}
BENCHMARK(quest_plus_replay)->Unit(benchmark::kMicrosecond);

void quest_plus_tables(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(QuestPlus(large_rule()));
}
BENCHMARK(quest_plus_tables)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::experiments
