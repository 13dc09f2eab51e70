#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/comparison.h"
#include "analysis/statistics/equivalence_test.h"
#include "analysis/statistics/omnibus_test.h"
#include "analysis/statistics/pairwise_tests.h"

namespace jnd::app {

/// "0.031"; a p value may be less than any number there is.
[[nodiscard]] std::string p_words(const std::optional<double>& p_value);

// Tests as people read them, printed to the standard output.

void print_comparison(const analysis::Comparison& result);
void print_equivalence(const analysis::EquivalenceTest& test);
void print_omnibus_test(const analysis::OmnibusTest& test,
                        const std::vector<std::string>& conditions);

/// One row for each pair of conditions. `tests` is not empty.
void print_pairwise_tests(const std::vector<analysis::PairwiseTest>& tests);

}  // namespace jnd::app
