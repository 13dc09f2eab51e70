#pragma once

#include <cstddef>
#include <vector>

#include "core/random_stream.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// How many rows the square of an order has, one of which a participant begins with; 0 for an
/// order without a square.
[[nodiscard]] std::size_t num_square_rows(const StimulusOrder& order, std::size_t num_stimuli);

/// Which stimulus comes in each trial of a block, as indices into `stimuli`: every one of them
/// `num_repetitions` times. The order depends on the stream alone.
///
/// Shuffled repetitions that keep a distance are drawn one after the other, each place among
/// those that the repetition before leaves: every order of the block that keeps to the
/// constraints is equally likely. Mixed ones are drawn by `mixed_order`. A square is
/// not drawn: repetition r takes the row r after the participant's first.
///
/// Throws `Error` if no order can keep to the constraints. Not real time.
[[nodiscard]] std::vector<std::size_t> stimulus_order(const StimulusOrder& order,
                                                      const std::vector<double>& stimuli,
                                                      int num_repetitions,
                                                      core::RandomStream& stream);

}  // namespace jnd::experiments
