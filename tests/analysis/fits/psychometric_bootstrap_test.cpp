#include "analysis/fits/psychometric_bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jnd::analysis {
namespace psychometric_bootstrap_test {

const std::vector<AnswerCount> kData = {{0.6, 1, 12}, {0.8, 3, 12}, {0.9, 5, 12},
                                        {1.1, 8, 12}, {1.3, 9, 12}, {1.6, 12, 12}};

PsychometricFit fit(const std::vector<AnswerCount>& data, int num_bootstrap,
                    std::uint64_t seed) {
  return fit_psychometric(data,
                          {.reference = 1.0, .num_bootstrap = num_bootstrap, .seed = seed});
}

TEST(PsychometricBootstrap, TheSameSeedGivesTheSameInterval) {
  const BootstrapInterval one = fit(kData, 500, 4).bootstrap;
  const BootstrapInterval same = fit(kData, 500, 4).bootstrap;
  const BootstrapInterval other = fit(kData, 500, 5).bootstrap;
  EXPECT_EQ(one.n, 500);
  EXPECT_EQ(*one.ci95.low, *same.ci95.low);
  EXPECT_EQ(*one.ci95.high, *same.ci95.high);
  EXPECT_NE(*one.ci95.low, *other.ci95.low);
}

TEST(PsychometricBootstrap, SpreadsAsWideAsTheStandardErrorSays) {
  std::vector<AnswerCount> many = kData;
  for (AnswerCount& row : many) {
    row.num_yes *= 400;
    row.num_trials *= 400;
  }
  const PsychometricFit found = fit(many, 4000, 1);
  const double width = *found.bootstrap.ci95.high - *found.bootstrap.ci95.low;
  EXPECT_NEAR(width / (2.0 * 1.96 * *found.standard_error), 1.0, 0.05);
}

TEST(PsychometricBootstrap, RefitsWithoutAnOptimumCountAtTheirLimitAndOpenAnEnd) {
  // The answers are nearly separated, so many redrawn sets are separated, and their w falls to
  // 0.
  const PsychometricFit found = fit({{0.5, 0, 5}, {0.9, 1, 5}, {1.2, 5, 5}, {2, 5, 5}}, 400, 1);
  ASSERT_EQ(found.status, FitStatus::kOk);
  EXPECT_GT(found.bootstrap.num_degenerate, 40);
  EXPECT_FALSE(found.bootstrap.ci95.low.has_value());
  EXPECT_GE(*found.bootstrap.ci95.high, *found.weber_fraction);
}

TEST(PsychometricBootstrap, NoneIsDrawnUnlessAsked) {
  EXPECT_EQ(fit(kData, 0, 1).bootstrap.n, 0);
  EXPECT_EQ(fit(kData, 0, 1).bootstrap.method, "");
}

}  // namespace psychometric_bootstrap_test
}  // namespace jnd::analysis
