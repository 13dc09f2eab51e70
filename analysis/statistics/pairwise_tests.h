#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/comparison.h"
#include "analysis/statistics/omnibus_test.h"

namespace jnd::analysis {

/// The test of one pair of conditions. Its values are `a` minus `b`.
struct PairwiseTest {
  std::string a, b;
  Comparison comparison;
  /// The p value adjusted for the number of pairs by Holm (1979). It is absent if the test has
  /// no p value.
  std::optional<double> p_value_holm;
};

/// Which test compares two conditions.
enum class PairwiseMethod {
  kPairedT,  ///< Student's t of the differences, which belongs to an analysis of variance.
  kWilcoxon  ///< The signed-rank test, which belongs to Friedman's test.
};

/// Tests every pair of conditions over the same people, in the order of the conditions. Each
/// test takes the variation of its own two conditions alone, so no sphericity is assumed.
/// Throws `core::Error` if a value is not finite. Not real time.
[[nodiscard]] std::vector<PairwiseTest> pairwise_tests(const RepeatedMeasures& data,
                                                       PairwiseMethod method);

}  // namespace jnd::analysis
