#pragma once

#include <cstddef>
#include <vector>

#include "core/random_stream.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Returns how many rows the square of an order has. A participant begins with one of them.
/// Returns 0 for an order without a square.
[[nodiscard]] std::size_t num_square_rows(const StimulusOrder& order, std::size_t num_stimuli);

/// Returns the stimulus of each trial of a block, as indices of `stimuli`: each comes
/// `num_repetitions` times. The order depends on the stream alone.
///
/// Shuffled repetitions that keep a distance are drawn one after another, each place among
/// those that the repetition before allows. All orders of the block that meet the constraints
/// are equally likely. Mixed orders are drawn by `mixed_order`. A square is not drawn:
/// repetition r takes the r-th row after the participant's first.
///
/// Throws `Error` if no order can meet the constraints. Not real time.
[[nodiscard]] std::vector<std::size_t> stimulus_order(const StimulusOrder& order,
                                                      const std::vector<double>& stimuli,
                                                      int num_repetitions,
                                                      core::RandomStream& stream);

}  // namespace jnd::experiments
