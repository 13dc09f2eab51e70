#pragma once

#include <cstddef>
#include <vector>

#include "core/random_stream.h"
#include "experiments/order/stimulus_order.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Returns trials with every stimulus of the block `num_repetitions` times, in the block's
/// order. `make` turns (repetition from 1, intensity) into a trial, and this function sets its
/// repetition and position. If repetitions are mixed, a repetition is as many trials as there
/// are stimuli.
template <typename Make>
[[nodiscard]] std::vector<PlannedTrial> ordered_repetitions(const Block& block,
                                                            int num_repetitions,
                                                            core::RandomStream& stream,
                                                            Make make) {
  std::vector<PlannedTrial> trials;
  const std::size_t per_repetition = block.intensities.size();
  for (const std::size_t stimulus :
       stimulus_order(block.order, block.intensities, num_repetitions, stream)) {
    const int repetition = static_cast<int>(trials.size() / per_repetition) + 1;
    const int position = static_cast<int>(trials.size() % per_repetition) + 1;
    trials.push_back(make(repetition, block.intensities[stimulus]));
    trials.back().repetition = repetition;
    trials.back().position = position;
  }
  return trials;
}

}  // namespace jnd::experiments
