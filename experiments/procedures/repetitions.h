#pragma once

#include <vector>

#include "core/random_stream.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Every intensity once in each of `num_repetitions`, each repetition in its own random order;
/// `make` turns (repetition from 1, intensity) into a trial, whose position is filled in here.
template <typename Make>
[[nodiscard]] std::vector<PlannedTrial> shuffled_repetitions(
    const std::vector<double>& intensities, int num_repetitions, core::RandomStream& stream,
    Make make) {
  std::vector<PlannedTrial> trials;
  for (int repetition = 1; repetition <= num_repetitions; ++repetition) {
    std::vector<double> order = intensities;
    stream.shuffle(order);
    int position = 0;
    for (const double intensity : order) {
      PlannedTrial trial = make(repetition, intensity);
      trial.repetition = repetition;
      trial.position = ++position;
      trials.push_back(trial);
    }
  }
  return trials;
}

}  // namespace jnd::experiments
