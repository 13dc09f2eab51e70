#include "analysis/fits/psychometric_redraw.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/psychometric_refit.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace psychometric_redraw_test {

TEST(AnswerNumbering, GivesEverySetOfAnswersANumberOfItsOwn) {
  const AnswerNumbering numbering({2.0, 5.0, 0.0, 1.0});
  std::set<std::uint64_t> numbers;
  for (double first = 0.0; first <= 2.0; ++first) {
    for (double second = 0.0; second <= 5.0; ++second) {
      for (double last = 0.0; last <= 1.0; ++last) {
        numbers.insert(numbering.of({first, second, 0.0, last}).value());
      }
    }
  }
  EXPECT_EQ(numbers.size(), 3U * 6U * 2U);
}

TEST(AnswerNumbering, HasNoNumbersWhereThereAreMoreSetsThanNumbers) {
  const std::vector<double> num_trials(40, 5.0), num_yes(40, 1.0);  // 6^40 sets are possible.
  EXPECT_FALSE(AnswerNumbering(num_trials).of(num_yes).has_value());
  const std::vector<double> few(20, 5.0);  // 6^20 = 3.7e15 sets are possible.
  EXPECT_TRUE(AnswerNumbering(few).of({num_yes.begin(), num_yes.begin() + 20}).has_value());
}

/// This also holds if the levels change in between.
TEST(LeastSquaresFractions, AreThoseOfAFitByLeastSquares) {
  LeastSquaresFractions fractions;
  const std::vector<std::vector<double>> levels = {{0.6, 0.8, 1.2, 1.6}, {0.7, 0.9, 1.3, 1.5}};
  core::RandomStream random(5, "least squares fractions");
  int num_without = 0;
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<AnswerCount> rows;
    for (const double x : levels[draw % 3 == 0 ? 1 : 0]) {
      rows.push_back({x, static_cast<std::int64_t>(random.below(6)), 5});
    }
    const PsychometricFit fit =
        fit_psychometric(rows, {.reference = 1.0,
                                .method = PsychometricMethod::kLeastSquares,
                                .intervals = false,
                                .solver = Solver::kNewton});
    const auto found = fractions.of(rows, 1.0);
    EXPECT_EQ(found, fit.weber_fraction) << draw;
    num_without += found ? 0 : 1;
  }
  EXPECT_GT(num_without, 10);
  EXPECT_LT(num_without, 190);
}

}  // namespace psychometric_redraw_test
}  // namespace jnd::analysis
