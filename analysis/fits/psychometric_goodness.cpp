#include "analysis/fits/psychometric_goodness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "analysis/fits/answer_scatter.h"
#include "analysis/fits/psychometric_limits.h"
#include "analysis/fits/psychometric_redraw.h"
#include "analysis/fits/psychometric_refit.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

using enum PsychometricMethod;

/// The log-likelihood of a level at its own proportion.
double saturated_term(double yes, double trials) {
  double value = 0.0;
  if (yes > 0.0) value += yes * std::log(yes / trials);
  if (yes < trials) value += (trials - yes) * std::log1p(-yes / trials);
  return value;
}

/// The root of a level's part of the deviance, with the sign of observed minus fitted.
double deviance_residual(double yes, double trials, double fitted) {
  const double no = trials - yes;
  double log_likelihood = 0.0;
  if (yes > 0.0) log_likelihood += yes * std::log(fitted);
  if (no > 0.0) log_likelihood += no * std::log1p(-fitted);
  const double share = 2.0 * (saturated_term(yes, trials) - log_likelihood);
  return std::copysign(std::sqrt(std::max(0.0, share)), yes / trials - fitted);
}

/// The probability of yes at intensity 0, which a logarithmic family keeps apart.
double probability_at_zero(const PsychometricLevels& levels, const PsychometricCurve& curve) {
  return levels.ends.low(curve.lapse, curve.guess);
}

/// How redrawn answers compare with the given ones.
struct Judgement {
  bool is_as_far = false, has_correlation = false, is_as_correlated = false;
};

struct StandardResiduals {
  /// Fitted probabilities and deviance residuals, by level.
  std::vector<double> fitted, deviance;
  double pearson = 0.0;  ///< The sum of squared standardised residuals.
};

StandardResiduals residuals_of(const PsychometricLevels& levels,
                               const PsychometricCurve& curve) {
  StandardResiduals all;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double fitted = curve.probability(levels, level);
    const double difference = levels.num_yes[level] - levels.num_trials[level] * fitted;
    const double variance = levels.num_trials[level] * fitted * (1.0 - fitted);
    if (variance > 0.0) all.pearson += difference * difference / variance;
    all.fitted.push_back(fitted);
    all.deviance.push_back(
        deviance_residual(levels.num_yes[level], levels.num_trials[level], fitted));
  }
  const double at_zero = probability_at_zero(levels, curve);
  const double variance = levels.zero_trials * at_zero * (1.0 - at_zero);
  const double difference = levels.zero_yes - levels.zero_trials * at_zero;
  if (variance > 0.0) all.pearson += difference * difference / variance;
  return all;
}

std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 3) return std::nullopt;
  const auto n = static_cast<double>(a.size());
  double mean_a = 0.0, mean_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / n;
    mean_b += b[i] / n;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  const double value = ab / std::sqrt(aa * bb);
  return aa > 0.0 && bb > 0.0 && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The log-likelihood to which a search without an optimum tends.
double limit_log_likelihood(const PsychometricLevels& levels, const FreeParameters& free,
                            PsychometricSupremum supremum) {
  return supremum == PsychometricSupremum::kStep
             ? -step_limit_cost(levels, kMaximumLikelihood, free[1], free[2])
             : -flat_limit_cost(levels, kMaximumLikelihood, free[1], free[2]);
}

}  // namespace

double deviance_of(const PsychometricLevels& levels, double log_likelihood) {
  double saturated =
      levels.zero_trials > 0.0 ? saturated_term(levels.zero_yes, levels.zero_trials) : 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    saturated += saturated_term(levels.num_yes[level], levels.num_trials[level]);
  }
  return std::max(0.0, 2.0 * (saturated - log_likelihood));
}

double pearson_statistic(const PsychometricLevels& levels, const PsychometricCurve& curve) {
  return residuals_of(levels, curve).pearson;
}

int residual_degrees_of_freedom(const PsychometricLevels& levels, const FreeParameters& free,
                                const PsychometricCurve& curve) {
  const double at_zero = probability_at_zero(levels, curve);
  const bool has_zero = levels.zero_trials > 0.0 && at_zero > 0.0 && at_zero < 1.0;
  return static_cast<int>(levels.size()) + (has_zero ? 1 : 0) - 1 - (free[1] ? 1 : 0) -
         (free[2] && curve.lapse > 0.0 ? 1 : 0) - (free[3] && curve.guess > 0.0 ? 1 : 0);
}

std::optional<double> misfit_p_value(const PsychometricLevels& levels,
                                     const FreeParameters& free,
                                     const PsychometricCurve& fitted) {
  std::vector<FittedAnswers> answers;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    answers.push_back(
        {levels.num_yes[level], levels.num_trials[level], fitted.probability(levels, level)});
  }
  const double at_zero = probability_at_zero(levels, fitted);
  if (levels.zero_trials > 0.0 && at_zero > 0.0 && at_zero < 1.0) {
    answers.push_back({levels.zero_yes, levels.zero_trials, at_zero});
  }
  const int num_fitted =
      static_cast<int>(answers.size()) - residual_degrees_of_freedom(levels, free, fitted);
  return misfit_p_value(answers, num_fitted);
}

PsychometricGoodness goodness_of_fit(const PsychometricSearch& search,
                                     const PsychometricLevels& levels,
                                     const PsychometricCurve& fitted,
                                     const GoodnessRedraws& redraws) {
  const int num_redraws = redraws.num;
  const auto log_likelihood = [&](const PsychometricLevels& data,
                                  const PsychometricCurve& curve) {
    return -psychometric_cost(data, kMaximumLikelihood, curve).value;
  };
  const StandardResiduals residuals = residuals_of(levels, fitted);
  PsychometricGoodness goodness;
  goodness.degrees_of_freedom = residual_degrees_of_freedom(levels, search.free(), fitted);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    goodness.residuals.push_back(
        {levels.intensity[level], residuals.fitted[level], residuals.deviance[level]});
  }
  if (goodness.degrees_of_freedom > 0) {
    goodness.overdispersion = residuals.pearson / goodness.degrees_of_freedom;
  }
  goodness.level_correlation = correlation(residuals.fitted, residuals.deviance);
  if (num_redraws == 0) return goodness;
  if (goodness.degrees_of_freedom < 1) {
    goodness.reason =
        "no degree of freedom is left: a curve with as many parameters as levels suits "
        "whatever is answered";
    return goodness;
  }

  const double deviance = deviance_of(levels, log_likelihood(levels, fitted));
  const AnswerRedraw redraw(levels, fitted);
  const PsychometricRefit refit(search, levels, fitted);
  core::RandomStream random(redraws.seed, "goodness of fit of a psychometric function");
  PsychometricLevels redrawn = levels;
  int num_as_far = 0, num_as_correlated = 0, num_correlations = 0;
  const auto judged = [&] {
    Judgement judgement;
    const PsychometricSearchResult found = refit.find(redrawn);
    const bool attained = found.supremum == PsychometricSupremum::kAttained;
    const double value =
        !attained ? limit_log_likelihood(redrawn, search.free(), found.supremum)
        : search.method() == kMaximumLikelihood ? -found.optimum.cost.value
                                                : log_likelihood(redrawn, found.optimum.curve);
    // With few answers ties are common, and rounding must not break them.
    judgement.is_as_far = deviance_of(redrawn, value) >= deviance * (1.0 - 1e-9);
    if (!attained || !redraws.correlation || !goodness.level_correlation) return judgement;
    const StandardResiduals of_redrawn = residuals_of(redrawn, found.optimum.curve);
    const auto other = correlation(of_redrawn.fitted, of_redrawn.deviance);
    judgement.has_correlation = other.has_value();
    judgement.is_as_correlated =
        other && std::fabs(*other) >= std::fabs(*goodness.level_correlation) - 1e-12;
    return judgement;
  };
  std::vector<double> num_trials = levels.num_trials;
  num_trials.push_back(levels.zero_trials);
  const AnswerNumbering numbering(num_trials);
  std::unordered_map<std::uint64_t, Judgement> known;
  std::vector<double> num_yes;
  for (int draw = 0; draw < num_redraws; ++draw) {
    redraw.draw(random, redrawn);
    num_yes = redrawn.num_yes;
    num_yes.push_back(redrawn.zero_yes);
    Judgement judgement;
    if (const auto number = numbering.of(num_yes)) {
      const auto [found, is_new] = known.try_emplace(*number);
      if (is_new) found->second = judged();
      judgement = found->second;
    } else {
      judgement = judged();
    }
    num_as_far += judgement.is_as_far ? 1 : 0;
    num_correlations += judgement.has_correlation ? 1 : 0;
    num_as_correlated += judgement.is_as_correlated ? 1 : 0;
  }
  goodness.n = num_redraws;
  goodness.p_value = (1.0 + num_as_far) / (1.0 + num_redraws);
  if (num_correlations > 0) {
    goodness.level_correlation_p_value = (1.0 + num_as_correlated) / (1.0 + num_correlations);
  }
  return goodness;
}

}  // namespace jnd::analysis
