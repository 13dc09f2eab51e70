#include "analysis/fits/psychometric_descent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analysis/fits/psychometric_search.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace psychometric_descent_test {

constexpr auto kLikelihood = PsychometricMethod::kMaximumLikelihood;
constexpr auto kLeastSquares = PsychometricMethod::kLeastSquares;

const std::vector<AnswerCount> kData = {{0.5, 2, 20},  {0.8, 5, 20},  {1.0, 9, 20},
                                        {1.3, 15, 20}, {2.0, 18, 20}, {3.0, 19, 20}};

TEST(PsychometricDescent, CeresAndNewtonComeToOneOptimumFromFarAway) {
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    for (const bool free_pse : {false, true}) {
      for (const bool free_lapse : {false, true}) {
        SCOPED_TRACE(testing::Message() << to_string(method) << free_pse << free_lapse);
        const PsychometricLevels levels = pooled_levels(kData, 1.0, free_pse);
        const FreeParameters free = {true, free_pse, free_lapse};
        const PsychometricCurve start = {0.7, free_pse ? 0.3 : 0.0, free_lapse ? 0.1 : 0.0};
        const PsychometricOptimum newton = minimised_by_newton(levels, method, free, start);
        const PsychometricOptimum ceres = minimised_by_ceres(levels, method, free, start);
        ASSERT_TRUE(newton.converged && ceres.converged);
        EXPECT_NEAR(ceres.curve.slope / newton.curve.slope, 1.0, 1e-9);
        EXPECT_NEAR(ceres.curve.offset, newton.curve.offset, 1e-9);
        EXPECT_NEAR(ceres.curve.lapse, newton.curve.lapse, 1e-9);
      }
    }
  }
}

TEST(PsychometricDescent, BothSolversFindTheSameFitsInDataOfEveryKindAndPrintNothing) {
  testing::internal::CaptureStderr();
  core::RandomStream random(9, "descent test");
  int num_attained = 0;
  for (int set = 0; set < 200; ++set) {
    std::vector<AnswerCount> data;
    for (const double intensity : {0.0, 0.5, 0.8, 0.95, 1.0, 1.1, 1.5, 2.5}) {
      if (!random.with_probability(intensity == 0.0 ? 0.2 : 0.6)) continue;
      const auto num_trials =
          static_cast<std::int64_t>(1 + random.below(set % 2 == 0 ? 5 : 60));
      data.push_back(
          {intensity,
           static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(num_trials) + 1)),
           num_trials});
    }
    for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
      for (const bool free_pse : {false, true}) {
        for (const bool free_lapse : {false, true}) {
          SCOPED_TRACE(testing::Message()
                       << set << to_string(method) << free_pse << free_lapse);
          const PsychometricLevels levels = pooled_levels(data, 1.0, free_pse);
          const PsychometricSearch search(levels, method, free_pse, free_lapse);
          const PsychometricSearchResult newton = search.find(levels, minimised_by_newton);
          const PsychometricSearchResult ceres = search.find(levels, minimised_by_ceres);
          ASSERT_EQ(newton.supremum, ceres.supremum) << newton.reason << ceres.reason;
          if (newton.supremum != PsychometricSupremum::kAttained) continue;
          ++num_attained;
          EXPECT_NEAR(ceres.optimum.curve.slope / newton.optimum.curve.slope, 1.0, 1e-5);
        }
      }
    }
  }
  EXPECT_GT(num_attained, 400);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace psychometric_descent_test
}  // namespace jnd::analysis
