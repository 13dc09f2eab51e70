#pragma once

#include <cstdint>
#include <utility>

namespace jnd::analysis {

/// The 95 % interval of Wilson (1927) for a proportion of independent answers. It lies within
/// [0, 1] for every count, and has some width even if all answers agree. Without trials it is
/// [0, 1]. Throws `core::Error` unless 0 <= num_yes <= num_trials.
[[nodiscard]] std::pair<double, double> wilson_interval(std::int64_t num_yes,
                                                        std::int64_t num_trials);

}  // namespace jnd::analysis
