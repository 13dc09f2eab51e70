#pragma once

#include <string>

#include "analysis/statistics/comparison.h"

namespace jnd::analysis {

/// Throws `core::Error` naming the column if a value is not finite.
void require_finite(const std::vector<double>& values, const char* name);

/// A comparison that nothing is known of yet: degenerate until it is filled in.
[[nodiscard]] Comparison started(Comparison::Kind kind, const char* method, std::size_t num_a,
                                 std::size_t num_b);

/// ", exact with ties": how the p value of a rank test comes about, after the test's name.
[[nodiscard]] std::string rank_method(bool exact, bool has_ties);

}  // namespace jnd::analysis
