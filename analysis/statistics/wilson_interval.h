#pragma once

#include <cstdint>
#include <utility>

namespace jnd::analysis {

/// The 95 % interval of Wilson (1927) for a proportion of independent answers: within [0, 1]
/// for every count, and of some width also where all answers agree. [0, 1] without trials.
/// Throws `core::Error` unless 0 <= num_yes <= num_trials.
[[nodiscard]] std::pair<double, double> wilson_interval(std::int64_t num_yes,
                                                        std::int64_t num_trials);

}  // namespace jnd::analysis
