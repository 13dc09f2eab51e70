#pragma once

#include "analysis/groups/comparison.h"

namespace jnd::analysis {

/// Throws `core::Error` naming the column if a value is not finite.
void require_finite(const std::vector<double>& values, const char* name);

/// A comparison that nothing is known of yet: degenerate until it is filled in.
[[nodiscard]] Comparison started(Comparison::Kind kind, const char* method, std::size_t num_a,
                                 std::size_t num_b);

}  // namespace jnd::analysis
