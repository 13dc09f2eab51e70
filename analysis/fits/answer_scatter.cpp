#include "analysis/fits/answer_scatter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/statistics/distributions.h"

namespace jnd::analysis {
namespace {

struct Count {
  double num_yes = 0.0, num_trials = 0.0;

  void add(const AnswerCount& row) {
    num_yes += static_cast<double>(row.num_yes);
    num_trials += static_cast<double>(row.num_trials);
  }
};

/// Divides rows of a single answer into quarters, in the order in which they were given. It
/// does not divide them if the table is sorted by level, because its order then does not tell
/// when the answers were given.
class Runs {
 public:
  explicit Runs(const std::vector<AnswerCount>& rows) {
    std::int64_t num_changes = 0;
    std::map<std::pair<double, double>, std::int64_t> asked;
    const AnswerCount* before = nullptr;
    for (const AnswerCount& row : rows) {
      if (row.num_trials != 1) continue;
      ++num_singles_;
      ++asked[{row.intensity, row.order}];
      num_changes += before != nullptr && before->intensity != row.intensity ? 1 : 0;
      before = &row;
    }
    is_in_order_ = num_singles_ > 0 && num_changes > 2 * std::ssize(asked);
  }

  /// The quarter, 0 to 3, of the next row of a single answer.
  std::int64_t next() {
    constexpr std::int64_t kNumRuns = 4;
    return is_in_order_ ? kNumRuns * at_++ / num_singles_ : 0;
  }

 private:
  std::int64_t num_singles_ = 0, at_ = 0;
  bool is_in_order_ = false;
};

/// Twice the log-likelihood that the observed share has above the predicted probability.
double deviance_of(double num_yes, double num_trials, double probability) {
  const double num_no = num_trials - num_yes;
  double deviance = 0.0;
  if (num_yes > 0.0) deviance += num_yes * std::log(num_yes / (num_trials * probability));
  if (num_no > 0.0) deviance += num_no * std::log(num_no / (num_trials * (1.0 - probability)));
  return std::max(0.0, 2.0 * deviance);
}

struct Moments {
  double mean = 0.0, variance = 0.0;
};

/// The moments of the deviance, summed over all numbers of yes that have a noticeable
/// probability.
Moments deviance_moments(double num_trials, double probability) {
  constexpr double kReach = 9.0, kMargin = 30.0;
  const double mean_yes = num_trials * probability;
  const double reach = kReach * std::sqrt(mean_yes * (1.0 - probability)) + kMargin;
  const double first = std::max(0.0, std::floor(mean_yes - reach));
  const double last = std::min(num_trials, std::ceil(mean_yes + reach));
  const double log_odds = std::log(probability) - std::log1p(-probability);
  const double log_all = std::lgamma(num_trials + 1.0) + num_trials * std::log1p(-probability);
  Moments raw;
  for (double num_yes = first; num_yes <= last; num_yes += 1.0) {
    const double weight =
        std::exp(log_all - std::lgamma(num_yes + 1.0) -
                 std::lgamma(num_trials - num_yes + 1.0) + num_yes * log_odds);
    const double deviance = deviance_of(num_yes, num_trials, probability);
    raw.mean += weight * deviance;
    raw.variance += weight * deviance * deviance;
  }
  return {raw.mean, raw.variance - raw.mean * raw.mean};
}

/// Keeps levels with several answers as they are. Levels with one answer cannot lie far from
/// any curve, so they are put into groups of ten with neighbouring probabilities (after Hosmer
/// and Lemeshow 1980).
std::vector<FittedAnswers> with_grouped_singles(const std::vector<FittedAnswers>& answers) {
  constexpr std::size_t kInGroup = 10;
  std::vector<FittedAnswers> result, singles;
  for (const FittedAnswers& one : answers) {
    if (one.num_trials > 0.0) (one.num_trials > 1.0 ? result : singles).push_back(one);
  }
  std::ranges::stable_sort(singles, {}, &FittedAnswers::probability);
  const std::size_t num_groups = singles.size() / kInGroup;
  for (std::size_t group = 0; group < num_groups; ++group) {
    const std::size_t begin = group * singles.size() / num_groups;
    const std::size_t end = (group + 1) * singles.size() / num_groups;
    FittedAnswers sum;
    for (std::size_t i = begin; i < end; ++i) {
      sum.num_yes += singles[i].num_yes;
      sum.num_trials += 1.0;
      sum.probability += singles[i].probability / static_cast<double>(end - begin);
    }
    result.push_back(sum);
  }
  return result;
}

}  // namespace

RowScatter& RowScatter::operator+=(const RowScatter& other) noexcept {
  statistic += other.statistic;
  degrees_of_freedom += other.degrees_of_freedom;
  return *this;
}

std::optional<double> RowScatter::p_value() const {
  if (degrees_of_freedom < 1) return std::nullopt;
  return chi_squared_above(statistic, degrees_of_freedom);
}

bool RowScatter::is_significant() const {
  const std::optional<double> p = p_value();
  return p && *p < kScatterBelow;
}

RowScatter row_scatter(const std::vector<AnswerCount>& rows) {
  struct Level {
    std::vector<Count> rows;
    /// Pooled single answers, by the quarter in which they were given.
    std::map<std::int64_t, Count> singles;
  };
  Runs runs(rows);
  std::map<std::pair<double, double>, Level> levels;
  for (const AnswerCount& row : rows) {
    if (row.num_trials == 0) continue;
    Level& level = levels[{row.intensity, row.order}];
    (row.num_trials > 1 ? level.rows.emplace_back() : level.singles[runs.next()]).add(row);
  }
  RowScatter scatter;
  for (auto& [asked, level] : levels) {
    for (const auto& [run, answers] : level.singles) level.rows.push_back(answers);
    Count all;
    for (const Count& row : level.rows) {
      all.num_yes += row.num_yes;
      all.num_trials += row.num_trials;
    }
    const double share = all.num_yes / all.num_trials;
    if (!(share > 0.0 && share < 1.0)) continue;
    for (const Count& row : level.rows) {
      const double excess = row.num_yes - row.num_trials * share;
      scatter.statistic += excess * excess / (row.num_trials * share * (1.0 - share));
    }
    scatter.degrees_of_freedom += static_cast<int>(level.rows.size()) - 1;
  }
  return scatter;
}

std::optional<double> misfit_p_value(const std::vector<FittedAnswers>& answers,
                                     double num_fitted) {
  constexpr double kCertain = 1e-12;
  double deviance = 0.0, num_levels = 0.0;
  Moments expected;
  for (const FittedAnswers& one : with_grouped_singles(answers)) {
    const double probability = std::clamp(one.probability, kCertain, 1.0 - kCertain);
    deviance += deviance_of(one.num_yes, one.num_trials, probability);
    const Moments moments = deviance_moments(one.num_trials, probability);
    expected.mean += moments.mean;
    expected.variance += moments.variance;
    num_levels += 1.0;
  }
  if (!(num_levels - num_fitted >= 1.0)) return std::nullopt;
  // Levels with a certain answer have almost no deviance, and add no degree of freedom.
  const double left = expected.mean - num_fitted;
  if (!(left > 0.0)) return std::nullopt;
  const double scale = expected.variance / expected.mean;
  return gamma_above(deviance, left / scale, scale);
}

}  // namespace jnd::analysis
