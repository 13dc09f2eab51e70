#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/comparison.h"
#include "analysis/statistics/equivalence_test.h"
#include "analysis/statistics/omnibus_test.h"
#include "analysis/statistics/pairwise_tests.h"

namespace jnd::app {

/// A p value as a number, such as "0.031". It may be too small for a double, and is then "<
/// 1e-300".
[[nodiscard]] std::string p_words(const std::optional<double>& p_value);

// These print tests, as people read them, to the standard output.

void print_comparison(const analysis::Comparison& result);
void print_equivalence(const analysis::EquivalenceTest& test);
void print_omnibus_test(const analysis::OmnibusTest& test,
                        const std::vector<std::string>& conditions);

/// One row for each pair of conditions. `tests` is not empty.
void print_pairwise_tests(const std::vector<analysis::PairwiseTest>& tests);

}  // namespace jnd::app
