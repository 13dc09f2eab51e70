#include "analysis/fits/psychometric_effects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "analysis/fits/answer_scatter.h"
#include "analysis/fits/probit_regression.h"
#include "analysis/statistics/distributions.h"
#include "core/psychometric_function.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr double kWaldReach = 1.959963984540054;

struct Term {
  std::string name, meaning;
  Eigen::VectorXd column;
};

void check(const std::vector<OrderedAnswers>& answers, double reference) {
  core::require_positive(reference, "reference");
  for (const OrderedAnswers& row : answers) {
    core::require_positive(row.intensity, "intensity");
    core::require(row.num_yes >= 0.0 && row.num_yes <= row.num_trials, "num_yes",
                  "0 to num_trials", row.num_yes);
  }
}

/// Running numbers, scaled from -0.5 at the first trial to 0.5 at the last. The vector is empty
/// if a row has no running number or all are equal.
Eigen::VectorXd times_of(const std::vector<OrderedAnswers>& answers) {
  Eigen::VectorXd times(static_cast<Eigen::Index>(answers.size()));
  for (std::size_t row = 0; row < answers.size(); ++row) {
    if (!answers[row].trial) return {};
    times(static_cast<Eigen::Index>(row)) = *answers[row].trial;
  }
  if (times.size() == 0 || !(times.maxCoeff() > times.minCoeff())) return {};
  const double first = times.minCoeff(), range = times.maxCoeff() - first;
  return (times.array() - first) / range - 0.5;
}

std::vector<Term> terms_of(const std::vector<OrderedAnswers>& answers,
                           const Eigen::VectorXd& log_ratio) {
  std::vector<Term> terms;
  terms.push_back({"response_bias", "z at the reference, above 0: yes too readily",
                   Eigen::VectorXd::Ones(log_ratio.size())});
  Eigen::VectorXd order(log_ratio.size());
  bool known = !answers.empty();
  for (std::size_t row = 0; row < answers.size(); ++row) {
    known = known && answers[row].test_first.has_value();
    order(static_cast<Eigen::Index>(row)) =
        answers[row].test_first.value_or(false) ? 0.5 : -0.5;
  }
  if (known && order.maxCoeff() > order.minCoeff()) {
    terms.push_back(
        {"interval_order", "z with the test first minus z with the test second", order});
  }
  const Eigen::VectorXd times = times_of(answers);
  if (times.size() > 0) {
    terms.push_back({"drift", "change of z at the reference from first to last trial", times});
    terms.push_back({"learning",
                     "change of the slope from first to last trial, over the mean slope",
                     times.cwiseProduct(log_ratio)});
  }
  return terms;
}

/// The design of the slope and the terms. The term `left_out` is missing.
Eigen::MatrixXd design_of(const Eigen::VectorXd& log_ratio, const std::vector<Term>& terms,
                          std::size_t left_out) {
  std::vector<Eigen::VectorXd> columns = {log_ratio};
  for (std::size_t term = 0; term < terms.size(); ++term) {
    if (term != left_out) columns.push_back(terms[term].column);
  }
  Eigen::MatrixXd design(log_ratio.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t place = 0; place < columns.size(); ++place) {
    design.col(static_cast<Eigen::Index>(place)) = columns[place];
  }
  return design;
}

std::string four_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

bool holds_zero(const Interval& ci95) { return *ci95.low <= 0.0 && *ci95.high >= 0.0; }

/// For example "95 % -0.2 to 0.3".
std::string words_of(const Interval& ci95) {
  return "95 % " + four_digits(*ci95.low) + " to " + four_digits(*ci95.high);
}

/// The terms that are reported at the reference, with their verb: "response_bias is" or
/// "response_bias and drift are".
std::string told_at_reference(const std::vector<Term>& terms) {
  const bool drifts = std::ranges::find(terms, "drift", &Term::name) != terms.end();
  return drifts ? "response_bias and drift are" : "response_bias is";
}

/// A warning if the answers scatter more than the regression explains, as rows of several
/// sessions do; "" otherwise. Rows of one answer each that were asked alike are pooled, at the
/// mean of their probabilities.
std::string scatter_of(const std::vector<OrderedAnswers>& answers,
                       const Eigen::VectorXd& expected_z, double num_fitted) {
  std::map<std::pair<double, int>, FittedAnswers> singles;
  std::vector<FittedAnswers> fitted;
  for (std::size_t row = 0; row < answers.size(); ++row) {
    const OrderedAnswers& one = answers[row];
    const double probability =
        core::standard_normal_cdf(expected_z(static_cast<Eigen::Index>(row)));
    if (one.num_trials > 1.0) {
      fitted.push_back({one.num_yes, one.num_trials, probability});
    } else if (one.num_trials > 0.0) {
      const int order = !one.test_first ? 0 : *one.test_first ? 1 : 2;
      FittedAnswers& all = singles[{one.intensity, order}];
      all.num_yes += one.num_yes;
      all.num_trials += 1.0;
      all.probability += (probability - all.probability) / all.num_trials;
    }
  }
  for (const auto& [asked, all] : singles) fitted.push_back(all);
  const std::optional<double> p_value = misfit_p_value(fitted, num_fitted);
  if (!p_value || !(*p_value < kScatterBelow)) return "";
  return "the answers scatter more than independent ones of this regression do (deviance, p < "
         "0.01), as those of several sessions or people may: every interval is too narrow and "
         "every p too small; run jnd fit effects on each session alone, and compare what they "
         "found as one value a session";
}

/// Warnings that the answers fall, or that nothing was asked near the reference.
std::vector<std::string> warnings_of(const PsychometricEffects& found,
                                     const std::vector<OrderedAnswers>& answers,
                                     double reference, const std::vector<Term>& terms) {
  std::vector<std::string> warnings;
  if (*found.slope_ci95.high < 0.0) {
    warnings.push_back("the answers fall as the intensity grows (slope " +
                       four_digits(*found.slope) + ", " + words_of(found.slope_ci95) +
                       "), as of somebody who answers the wrong way round: then every effect "
                       "but learning has the wrong sign");
  }
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const OrderedAnswers& one : answers) {
    if (!(one.num_trials > 0.0)) continue;
    least = std::min(least, one.intensity);
    most = std::max(most, one.intensity);
  }
  if (reference < least || reference > most) {
    warnings.push_back("the reference " + four_digits(reference) +
                       " lies outside the levels, " + four_digits(least) + " to " +
                       four_digits(most) + ": " + told_at_reference(terms) +
                       " extrapolated to where nothing was asked");
  }
  return warnings;
}

}  // namespace

PsychometricEffects psychometric_effects(const std::vector<OrderedAnswers>& answers,
                                         double reference) {
  check(answers, reference);
  const auto size = static_cast<Eigen::Index>(answers.size());
  Eigen::VectorXd log_ratio(size), num_yes(size), num_trials(size);
  for (Eigen::Index row = 0; row < size; ++row) {
    const OrderedAnswers& one = answers[static_cast<std::size_t>(row)];
    log_ratio(row) = std::log(one.intensity / reference);
    num_yes(row) = one.num_yes;
    num_trials(row) = one.num_trials;
  }
  const std::vector<Term> terms = terms_of(answers, log_ratio);
  const ProbitRegression full =
      answers.empty()
          ? ProbitRegression{.status = FitStatus::kDegenerate, .reason = "no answers"}
          : fit_probit(design_of(log_ratio, terms, terms.size()), num_yes, num_trials);
  PsychometricEffects found;
  if (full.status == FitStatus::kOk) {
    const double reach = kWaldReach * std::sqrt(full.covariance(0, 0));
    found.slope = full.coefficients(0);
    found.slope_ci95 = {*found.slope - reach, *found.slope + reach};
    found.warnings = warnings_of(found, answers, reference, terms);
    const Eigen::MatrixXd design = design_of(log_ratio, terms, terms.size());
    const std::string scatter =
        scatter_of(answers, design * full.coefficients, static_cast<double>(design.cols()));
    if (!scatter.empty()) found.warnings.push_back(scatter);
  }
  for (std::size_t term = 0; term < terms.size(); ++term) {
    PsychometricEffect effect{.status = full.status,
                              .reason = full.reason,
                              .name = terms[term].name,
                              .meaning = terms[term].meaning};
    if (full.status == FitStatus::kOk) {
      const auto at = static_cast<Eigen::Index>(term) + 1;
      // Learning is the slope's change in units of the mean slope, which is taken as known.
      const bool is_share = effect.name == "learning";
      const double unit = is_share ? *found.slope : 1.0;
      const double reach = kWaldReach * std::sqrt(full.covariance(at, at)) / std::fabs(unit);
      if (is_share && holds_zero(found.slope_ci95)) {
        effect.reason = "the mean slope is not told from 0 (" + words_of(found.slope_ci95) +
                        "), so that its change is no share of it";
      } else {
        effect.estimate = full.coefficients(at) / unit;
        effect.ci95 = {*effect.estimate - reach, *effect.estimate + reach};
      }
      const ProbitRegression without =
          fit_probit(design_of(log_ratio, terms, term), num_yes, num_trials);
      effect.status = without.status;
      if (without.status != FitStatus::kOk) effect.reason = without.reason;
      if (without.status == FitStatus::kOk) {
        const double gain = 2.0 * (full.log_likelihood - without.log_likelihood);
        effect.statistic = std::max(0.0, gain);
        effect.p_value = chi_squared_above(*effect.statistic, 1.0);
      }
    }
    found.effects.push_back(std::move(effect));
  }
  return found;
}

TrialTrend trial_trend(const std::vector<OrderedAnswers>& answers, double reference) {
  check(answers, reference);
  struct Level {
    double n = 0.0, yes = 0.0, time = 0.0, time_time = 0.0, yes_time = 0.0;
  };
  std::map<double, Level> levels;
  const Eigen::VectorXd times = times_of(answers);
  if (times.size() == 0) return {};
  for (std::size_t row = 0; row < answers.size(); ++row) {
    const OrderedAnswers& one = answers[row];
    const double time = times(static_cast<Eigen::Index>(row));
    Level& level = levels[one.intensity];
    level.n += one.num_trials;
    level.yes += one.num_yes;
    level.time += one.num_trials * time;
    level.time_time += one.num_trials * time * time;
    level.yes_time += one.num_yes * time;
  }
  double drift = 0.0, learning = 0.0, drift_variance = 0.0, learning_variance = 0.0;
  for (const auto& [intensity, level] : levels) {
    if (level.n < 2.0) continue;
    const double covariance = level.yes_time - level.yes * level.time / level.n;
    const double of_answers = level.yes - level.yes * level.yes / level.n;
    const double of_times = level.time_time - level.time * level.time / level.n;
    const double variance = of_answers * of_times / (level.n - 1.0);
    drift += covariance;
    drift_variance += variance;
    if (intensity == reference) continue;
    learning += intensity > reference ? covariance : -covariance;
    learning_variance += variance;
  }
  TrialTrend trend;
  if (drift_variance > 0.0) trend.drift = drift / std::sqrt(drift_variance);
  if (learning_variance > 0.0) trend.learning = learning / std::sqrt(learning_variance);
  return trend;
}

}  // namespace jnd::analysis
