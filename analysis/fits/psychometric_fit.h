#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/fits/beta_prior.h"
#include "analysis/fits/psychometric_family.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// How often "more than the reference" was answered at one intensity.
struct AnswerCount {
  /// The intensity, >= 0. At 0 the curve is at its lower asymptote.
  double intensity = 0.0;
  std::int64_t num_yes = 0;  ///< The number of "yes", 0 .. num_trials.
  /// The number of trials, >= 0. Rows without trials are ignored.
  std::int64_t num_trials = 0;
  double order = 0.0;  ///< The interval in which the test lay, as `order_of` codes it.
};

inline constexpr double kTestFirst = -0.5, kTestSecond = 0.5;

/// Codes the interval that held the test, 1 or 2. The code is 0 if the interval is always the
/// same or unknown.
[[nodiscard]] constexpr double order_of(std::optional<std::int64_t> test_interval) noexcept {
  if (!test_interval) return 0.0;
  return *test_interval == 1 ? kTestFirst : kTestSecond;
}

enum class PsychometricMethod {
  kMaximumLikelihood,  ///< "ml"
  kLeastSquares,       ///< "lsq": one unweighted term per level, as in the thesis.
};

[[nodiscard]] constexpr std::string_view to_string(PsychometricMethod method) noexcept {
  return method == PsychometricMethod::kMaximumLikelihood ? "ml" : "lsq";
}

/// How the intervals account for answers that scatter more than binomial ones.
enum class Overdispersion {
  kNone,  ///< Answers are independent and binomial.
  /// Variances are multiplied by Pearson's chi-squared over its degrees of freedom, >= 1. It is
  /// computed over the rows, or over the levels if rows hold single answers.
  kScaled,
  /// Answers are beta-binomial; see `BetaBinomialFit`. The estimates change too.
  kBetaBinomial,
};

/// "none", "scaled" or "beta-binomial".
[[nodiscard]] constexpr std::string_view to_string(Overdispersion overdispersion) noexcept {
  if (overdispersion == Overdispersion::kScaled) return "scaled";
  return overdispersion == Overdispersion::kBetaBinomial ? "beta-binomial" : "none";
}

enum class BootstrapKind {
  kParametric,     ///< Answers are redrawn from the fitted curve.
  kNonparametric,  ///< Answers are redrawn from the answers, within each level.
};

struct BootstrapOptions {
  int num_refits = 0;
  std::uint64_t seed = 1;
  BootstrapKind kind = BootstrapKind::kParametric;
};

struct PsychometricOptions {
  /// The reference, > 0, in the unit of the intensities. It is the pse unless the pse is free.
  double reference = 0.0;
  PsychometricFamily family = PsychometricFamily::kWeber;
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  bool free_pse = false;  ///< Whether the pse is free. In some families it always is.
  bool free_lapse = false;
  /// The share of right answers if nothing is felt, in [0, 1): 0 for yes-no answers, 1 / m for
  /// a forced choice among m.
  double guess_rate = 0.0;
  /// The lapse rate if it is not free. It must leave the curve a rise.
  double lapse_rate = 0.0;
  /// Whether lapses occur at both ends, or only at the upper end; see `PsychometricEnds`.
  bool symmetric_lapse = true;
  /// Gives each order of the intervals a pse of its own if the orders differ. Only kWeber by
  /// maximum likelihood without lapses and guesses permits it. Without this option the orders
  /// are pooled.
  bool by_order = false;
  /// Overdispersion needs maximum likelihood, without bootstrap and posterior, which assume
  /// binomial answers.
  Overdispersion overdispersion = Overdispersion::kNone;
  int num_bootstrap = 0;  ///< The number of bootstrap refits; 0 for no bootstrap.
  BootstrapKind bootstrap_kind = BootstrapKind::kParametric;
  bool diagnostics = false;  ///< Whether to compute residuals and overdispersion.
  /// Whether warnings also name the options of `jnd fit weber` that would help, and say that
  /// the answers fall.
  bool advice = false;
  /// Whether to warn if the counts look like right answers of a forced choice.
  bool guess_unknown = false;
  /// The number of redraws for the p values of the diagnostics; 0 for no p values.
  int num_goodness = 0;
  /// Whether to compute the p value of the residuals' correlation too, which takes a third of
  /// the time.
  bool goodness_of_correlation = true;
  /// The number of redraws that widen likelihood-ratio intervals which are known to be too
  /// narrow. These are intervals with a free pse or varying orders if no level has 30 answers;
  /// see `CalibratedDrops`. It is 0 for no calibration, and otherwise at least 200. Only kWeber
  /// by maximum likelihood without lapses, guesses and overdispersion permits it.
  int num_calibration = 0;
  bool posterior = false;                  ///< Whether to compute the Bayesian estimate too.
  BetaPrior rate_prior = kUsualRatePrior;  ///< The prior of a free lapse rate in the posterior.
  /// Whether to report the posterior medians under other weights of this prior.
  bool prior_sensitivity = false;
  /// The seed of everything that is drawn. The same seed gives the same numbers.
  std::uint64_t seed = 1;
  /// Whether to compute profile intervals. False suffices if only w is wanted.
  bool intervals = true;
  Solver solver = Solver::kCeres;
};

/// Intervals of the Weber fraction from redrawn answers.
struct BootstrapInterval {
  int n = 0;  ///< The number of refits that were asked for.
  /// The number of refits without an optimum, which count at their limit.
  int num_degenerate = 0;
  /// The percentile interval. An end that falls among refits without an optimum is open.
  Interval ci95;
  std::string method;  ///< The method; "" if no bootstrap was asked for.
  /// The interval corrected for bias and acceleration. If it is open, `bca_reason` says why.
  Interval bca_ci95;
  std::string bca_reason;
  std::optional<double> bias_correction, acceleration;
};

/// How well the curve describes the answers.
struct PsychometricGoodness {
  /// The number of redraws behind the p values; 0 if none were asked for.
  int n = 0;
  /// The share of redrawn data whose deviance is at least as large.
  std::optional<double> p_value;
  std::string reason;          ///< Why a p value that was asked for is absent; "" otherwise.
  int degrees_of_freedom = 0;  ///< The number of levels minus the number of parameters.
  /// Pearson's chi-squared over its degrees of freedom. It is about 1 for binomial answers.
  std::optional<double> overdispersion;
  /// The correlation of the deviance residuals with the fitted probability. It shows a curve of
  /// the wrong shape.
  std::optional<double> level_correlation, level_correlation_p_value;
  struct Residual {
    double intensity, fitted, deviance_residual;
  };
  /// The residuals of the levels > 0. Their squares add up to the deviance.
  std::vector<Residual> residuals;
};

/// What was found about answers that scatter more than independent ones.
struct PsychometricOverdispersion {
  Overdispersion model = Overdispersion::kNone;
  std::optional<double> factor;  ///< For "scaled", the factor of the variances.
  /// For "beta-binomial", the correlation of two answers of one row.
  std::optional<double> correlation;
  /// For "beta-binomial", its log-likelihood. `PsychometricFit` holds the binomial one.
  std::optional<double> log_likelihood;
  std::string note;  ///< Why there is no value; "" if there is one.
};

/// How far the log-likelihood falls from its maximum to the ends of a calibrated interval.
struct PsychometricCalibration {
  int n = 0;  ///< The number of redraws; 0 if the intervals are not calibrated.
  double weber_fraction_drop = 0.0, pse_drop = 0.0;
};

/// Medians of the posterior under another weight of the rates' prior.
struct PosteriorPriorEffect {
  double weight = 1.0;  ///< The power to which the prior's density is raised; 0 means no prior.
  BetaPrior prior;      ///< The prior with this weight.
  std::optional<double> weber_fraction, pse, lapse_rate;
};

/// Medians and central 95 % intervals of the posterior.
struct PsychometricPosterior {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  std::string priors, note;
  std::optional<double> weber_fraction, pse, lapse_rate;
  Interval weber_fraction_ci95;
  std::optional<Interval> pse_ci95;
  /// The effects of the prior's weight, if they were asked for.
  std::vector<PosteriorPriorEffect> prior_effects;
};

/// A fitted psychometric function, with the words of the JSON output. If `status` is not kOk
/// all numbers are absent, however plausible they would look.
///
/// Without `overdispersion` the intervals assume that answers are independent and binomial at
/// each level, and that the curve is right. A drifting criterion, or lapses that the model
/// leaves out, make them too narrow. At five trials a level the mean of individual Weber
/// fractions is biased without bound, but their median is not. Likelihood-ratio intervals cover
/// 94 % there, bootstrap intervals only 74 to 95 %.
struct PsychometricFit {
  FitStatus status = FitStatus::kNotRun;
  /// Why there is no value. If the pse of a curve is not > 0, why there is no Weber fraction.
  /// "" otherwise.
  std::string reason;
  /// There is no fit because the answers form a step, where w tends to 0.
  bool is_separated = false;
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  std::optional<double> weber_fraction;
  /// For ml, the likelihood-ratio interval, profiled over the other free parameters and
  /// calibrated if `num_calibration` asks for it. For lsq, the profile of the sum of squares at
  /// F(1, levels - parameters), which is open if no degree of freedom is left.
  Interval weber_fraction_ci95;
  /// The standard error of w. For ml it comes from the observed information, with a lapse rate
  /// on its bound 0 held there. For lsq it comes from sse / (levels - parameters) (J^T J)^-1,
  /// and is absent if no degree of freedom is left.
  std::optional<double> standard_error;
  /// The sum of k ln f + (n-k) ln(1-f), without binomial coefficients.
  std::optional<double> log_likelihood;
  /// Twice the log-likelihood that the saturated model has above this fit, >= 0.
  std::optional<double> deviance;
  /// The probability that answers of this curve lie at least as far from it; see
  /// `answer_scatter.h`. It is absent if no degree of freedom is left or no intervals are asked
  /// for.
  std::optional<double> misfit_p_value;
  std::optional<double> pse;
  std::optional<Interval> pse_ci95;  ///< Its interval, which is absent if the pse is not free.
  /// ln pse with the test second minus ln pse with the test first. Only `by_order` gives it.
  std::optional<double> order_effect_ln;
  std::optional<double> lapse_rate;
  double guess_rate = 0.0;          ///< The guess rate that was given.
  bool symmetric_lapse = true;      ///< Whether lapses occur at both ends.
  std::optional<double> r_squared;  ///< For lsq, 1 - sse / sst about the mean proportion.
  BootstrapInterval bootstrap;
  PsychometricFamily family = PsychometricFamily::kWeber;
  struct Parameter {
    std::string_view name;
    double value;
  };
  /// The family's own parameters, in addition to w, pse and lapse rate.
  std::vector<Parameter> parameters;
  PsychometricCalibration calibration;
  PsychometricOverdispersion overdispersion;
  PsychometricGoodness goodness;
  PsychometricPosterior posterior;
  /// Sentences that say why an interval is known to be too narrow, or why the value rests on
  /// less than it seems to.
  std::vector<std::string> warnings;
  int num_levels = 0;           ///< The number of distinct intensities with trials.
  std::int64_t num_trials = 0;  ///< The number of trials over all levels.
};

/// Fits a curve of the family, p(x) = lapse + (1 - 2 lapse) F, or between the ends that
/// `PsychometricEnds` describes. For every family the pse is where F = 0.5, and F = Phi(1) =
/// 84.13 % at pse (1 + w). For kGauss w is the standard deviation divided by the pse. kWeber is
/// Phi( ln(x / pse) / ln(1 + w) ), the curve of core::PsychometricFunction (Bergmann Tiest et
/// al. 2013). In its slope s = 1 / ln(1 + w) > 0 it is a probit line, whose likelihood has one
/// optimum. Rows of the same intensity are pooled into one level. The optimum is global. Least
/// squares, lapses and guesses can have several minima, so their search starts from a grid.
///
/// The status is `degenerate` exactly if the supremum is not attained or more than one curve
/// attains it. This happens at infinite slope (separated answers), at slope 0 (flat, inverted
/// or all alike), and if there are too few levels to tell the free parameters apart. If the pse
/// of kGauss is not > 0, only the Weber fraction is absent, because there is nothing to which
/// it could be relative. A lapse rate on its bound 0 is an optimum. Throws `core::Error` for a
/// reference that is not > 0, an intensity that is not finite and >= 0, counts that are not 0
/// <= num_yes <= num_trials, rates out of range, and options that `by_order` does not permit.
/// Not real time.
[[nodiscard]] PsychometricFit fit_psychometric(const std::vector<AnswerCount>& data,
                                               const PsychometricOptions& options);

}  // namespace jnd::analysis
