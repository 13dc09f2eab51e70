#pragma once

#include <string>

#include "analysis/statistics/comparison.h"

namespace jnd::analysis {

/// Throws `core::Error` that names the column if a value is not finite.
void require_finite(const std::vector<double>& values, const char* name);

/// A comparison without values. Its status is degenerate until it is filled in.
[[nodiscard]] Comparison started(Comparison::Kind kind, const char* method, std::size_t num_a,
                                 std::size_t num_b);

/// How a rank test computes its p value, such as ", exact with ties". It follows the test's
/// name.
[[nodiscard]] std::string rank_method(bool exact, bool has_ties);

}  // namespace jnd::analysis
