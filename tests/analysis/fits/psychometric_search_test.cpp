#include "analysis/fits/psychometric_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/fits/psychometric_limits.h"
#include "core/random_stream.h"
#include "support/sanitizer.h"

namespace jnd::analysis {
namespace psychometric_search_test {

constexpr auto kLikelihood = PsychometricMethod::kMaximumLikelihood;
constexpr auto kLeastSquares = PsychometricMethod::kLeastSquares;

struct Case {
  PsychometricMethod method;
  bool free_pse, free_lapse;
};

constexpr Case kCases[] = {
    {kLikelihood, false, false},  {kLikelihood, true, false},    {kLikelihood, false, true},
    {kLikelihood, true, true},    {kLeastSquares, false, false}, {kLeastSquares, true, false},
    {kLeastSquares, false, true}, {kLeastSquares, true, true},
};

/// Returns few levels and trials with random answers. Half of such data have no optimum.
std::vector<AnswerCount> random_data(core::RandomStream& random) {
  const double intensities[] = {0.0, 0.5, 0.8, 0.95, 1.0, 1.1, 1.5, 2.5};
  std::vector<AnswerCount> data;
  const bool ordered = random.with_probability(0.6);
  for (const double intensity : intensities) {
    if (!random.with_probability(intensity == 0.0 ? 0.2 : 0.6)) continue;
    const auto num_trials = static_cast<std::int64_t>(1 + random.below(5));
    const double p = ordered ? intensity / (1.0 + intensity) : random.uniform();
    std::int64_t num_yes = 0;
    for (int trial = 0; trial < num_trials; ++trial) {
      num_yes += random.with_probability(p) ? 1 : 0;
    }
    data.push_back({intensity, num_yes, num_trials});
  }
  return data;
}

double lowest_of_dense_grid(const PsychometricLevels& levels, const Case& how) {
  double lowest = std::numeric_limits<double>::infinity();
  for (double slope = 0.003; slope < 400.0; slope *= 1.35) {
    std::vector<double> offsets = {0.0};
    if (how.free_pse) {
      for (double pse = -1.6; pse <= 1.6; pse += 0.04) offsets.push_back(-slope * pse);
      for (double z = -4.0; z <= 4.0; z += 0.5) offsets.push_back(z);
    }
    for (const double offset : offsets) {
      for (double lapse = 0.0; lapse < 0.5; lapse += 0.05) {
        lowest = std::min(lowest,
                          psychometric_cost(levels, how.method, {slope, offset, lapse}).value);
        if (!how.free_lapse) break;
      }
    }
  }
  return lowest;
}

TEST(PsychometricSearch, NoCurveOfADenseGridIsBetterThanTheOptimumOrTheLimit) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  core::RandomStream random(1, "search test");
  int num_attained = 0, num_limits = 0;
  for (int set = 0; set < 150; ++set) {
    const std::vector<AnswerCount> data = random_data(random);
    for (const Case& how : kCases) {
      SCOPED_TRACE(testing::Message()
                   << "set " << set << ", " << to_string(how.method) << ", free pse "
                   << how.free_pse << ", free lapse " << how.free_lapse);
      const PsychometricLevels levels = pooled_levels(data, 1.0, how.free_pse);
      const PsychometricSearch search(levels, how.method, how.free_pse, how.free_lapse);
      const PsychometricSearchResult found = search.find(levels, minimised_by_ceres);
      ASSERT_NE(found.supremum, PsychometricSupremum::kNotConverged);
      if (found.supremum == PsychometricSupremum::kUnidentified ||
          found.supremum == PsychometricSupremum::kImpossible) {
        continue;
      }
      const double limit =
          std::min(step_limit_cost(levels, how.method, how.free_pse, how.free_lapse),
                   flat_limit_cost(levels, how.method, how.free_pse, how.free_lapse));
      const double on_grid = lowest_of_dense_grid(levels, how);
      if (found.supremum == PsychometricSupremum::kAttained) {
        ++num_attained;
        EXPECT_LT(found.optimum.cost.value, limit);
        EXPECT_LE(found.optimum.cost.value, on_grid + 1e-12);
      } else {
        ++num_limits;
        EXPECT_GE(on_grid, limit - 1e-9) << found.reason;
      }
    }
  }
  EXPECT_GT(num_attained, 100);
  EXPECT_GT(num_limits, 100);
}

}  // namespace psychometric_search_test
}  // namespace jnd::analysis
