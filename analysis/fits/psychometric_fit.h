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
  double intensity = 0.0;       ///< >= 0; at 0 the curve is at its lower asymptote.
  std::int64_t num_yes = 0;     ///< 0 .. num_trials
  std::int64_t num_trials = 0;  ///< >= 0; a row without trials says nothing.
  double order = 0.0;           ///< In which interval the test lay, see `order_of`.
};

inline constexpr double kTestFirst = -0.5, kTestSecond = 0.5;

/// Of the interval that held the test, 1 or 2; 0 where it always lies in the same or that is
/// not known.
[[nodiscard]] constexpr double order_of(std::optional<std::int64_t> test_interval) noexcept {
  if (!test_interval) return 0.0;
  return *test_interval == 1 ? kTestFirst : kTestSecond;
}

enum class PsychometricMethod {
  kMaximumLikelihood,  ///< "ml"
  kLeastSquares,       ///< "lsq": one unweighted term per level, as the thesis fits.
};

[[nodiscard]] constexpr std::string_view to_string(PsychometricMethod method) noexcept {
  return method == PsychometricMethod::kMaximumLikelihood ? "ml" : "lsq";
}

/// How far the intervals allow answers to scatter.
enum class Overdispersion {
  kNone,  ///< Independent binomial answers.
  /// Variances times Pearson's chi-squared over its degrees of freedom, >= 1: over the rows, of
  /// rows with a single answer over the levels.
  kScaled,
  kBetaBinomial,  ///< See `BetaBinomialFit`: the values move, too.
};

/// "none", "scaled", "beta-binomial"
[[nodiscard]] constexpr std::string_view to_string(Overdispersion overdispersion) noexcept {
  if (overdispersion == Overdispersion::kScaled) return "scaled";
  return overdispersion == Overdispersion::kBetaBinomial ? "beta-binomial" : "none";
}

enum class BootstrapKind {
  kParametric,     ///< Answers drawn from the fitted curve.
  kNonparametric,  ///< Answers drawn from the answers, within each level.
};

struct BootstrapOptions {
  int num_refits = 0;
  std::uint64_t seed = 1;
  BootstrapKind kind = BootstrapKind::kParametric;
};

struct PsychometricOptions {
  double reference = 0.0;  ///< > 0, unit of the intensities. The pse, unless that is free.
  PsychometricFamily family = PsychometricFamily::kWeber;
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  bool free_pse = false;  ///< Some families have it free always.
  bool free_lapse = false;
  /// Share of right answers where nothing is felt, [0, 1): 0 for yes and no, 1 / m for a forced
  /// choice among m.
  double guess_rate = 0.0;
  double lapse_rate = 0.0;  ///< Where it is not free; leaves the curve a rise.
  /// Lapses at both ends, else at the upper end alone: see `PsychometricEnds`.
  bool symmetric_lapse = true;
  /// Where the rows' orders differ, let them have pses of their own: kWeber by maximum
  /// likelihood without lapses and guesses only. Without this option the orders are pooled.
  bool by_order = false;
  /// By maximum likelihood, without bootstrap and posterior, which draw binomial answers.
  Overdispersion overdispersion = Overdispersion::kNone;
  int num_bootstrap = 0;  ///< Refits of the bootstrap; 0 leaves it out.
  BootstrapKind bootstrap_kind = BootstrapKind::kParametric;
  bool diagnostics = false;  ///< Residuals and overdispersion.
  /// Warnings also name the options of `jnd fit weber` that the answers call for, and say
  /// where the answers fall.
  bool advice = false;
  bool guess_unknown = false;  ///< Also a warning where the counts look like right answers.
  int num_goodness = 0;        ///< Redraws for the p values beside them; 0 leaves those out.
  /// Also that of the residuals' correlation, which takes a third of the time.
  bool goodness_of_correlation = true;
  /// Redraws that widen the likelihood-ratio intervals where they are known to be too narrow:
  /// with a free pse, or orders that vary, and no level of 30 answers; see `CalibratedDrops`. 0
  /// leaves them as they are, else 200 or more. kWeber by maximum likelihood without lapses,
  /// guesses and overdispersion alone.
  int num_calibration = 0;
  bool posterior = false;  ///< Whether the Bayesian estimate is computed as well.
  BetaPrior rate_prior = kUsualRatePrior;  ///< Of the posterior's free lapse rate.
  /// Also what the posterior's medians would be with other weights of that prior.
  bool prior_sensitivity = false;
  std::uint64_t seed = 1;  ///< Seed of all that is drawn: the same numbers again.
  bool intervals = true;   ///< False leaves out the profile intervals, where only w is wanted.
  Solver solver = Solver::kCeres;
};

/// Intervals of the Weber fraction over answers drawn anew.
struct BootstrapInterval {
  int n = 0;               ///< Refits asked for.
  int num_degenerate = 0;  ///< Of these, refits without an optimum, counted at their limit.
  Interval ci95;           ///< Percentiles. An end among refits without an optimum is open.
  std::string method;      ///< "" if none was asked for.
  Interval bca_ci95;       ///< Corrected for bias and acceleration; open with a reason.
  std::string bca_reason;
  std::optional<double> bias_correction, acceleration;
};

/// How well the curve describes the answers.
struct PsychometricGoodness {
  int n = 0;                      ///< Redraws behind the p values; 0: none were asked for.
  std::optional<double> p_value;  ///< Share of redrawn data with at least this deviance.
  std::string reason;             ///< Why p was asked for and there is none; else "".
  int degrees_of_freedom = 0;     ///< Levels minus parameters.
  std::optional<double> overdispersion;  ///< Pearson's chi-squared over these; about 1.
  /// Of the deviance residuals with the fitted probability: a curve of the wrong shape.
  std::optional<double> level_correlation, level_correlation_p_value;
  struct Residual {
    double intensity, fitted, deviance_residual;
  };
  std::vector<Residual> residuals;  ///< By level > 0; the squares add up to the deviance.
};

/// What was found of answers that scatter more than independent ones.
struct PsychometricOverdispersion {
  Overdispersion model = Overdispersion::kNone;
  std::optional<double> factor;          ///< scaled: of the variances.
  std::optional<double> correlation;     ///< beta-binomial: of two answers of one row.
  std::optional<double> log_likelihood;  ///< beta-binomial; `PsychometricFit` has the binomial.
  std::string note;                      ///< Why there is none; "" if there is.
};

/// How far the log-likelihood may fall to the ends of an interval that was calibrated.
struct PsychometricCalibration {
  int n = 0;  ///< Redraws; 0: the intervals are not calibrated.
  double weber_fraction_drop = 0.0, pse_drop = 0.0;
};

/// Medians of the posterior with another weight of the prior of its rates.
struct PosteriorPriorEffect {
  double weight = 1.0;  ///< Power of the prior's density; 0 is none.
  BetaPrior prior;      ///< With it.
  std::optional<double> weber_fraction, pse, lapse_rate;
};

/// Medians and central 95 % of the posterior.
struct PsychometricPosterior {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  std::string priors, note;
  std::optional<double> weber_fraction, pse, lapse_rate;
  Interval weber_fraction_ci95;
  std::optional<Interval> pse_ci95;
  std::vector<PosteriorPriorEffect> prior_effects;  ///< Where they were asked for.
};

/// A fitted psychometric function, with the words of the JSON output. Where `status` is not
/// kOk no number is given, however plausible one would look.
///
/// What the intervals assume, but for `overdispersion`: answers independent and binomial at
/// each level, and the curve right. A drifting criterion or lapses left out of the model make
/// them too narrow. At five trials a level the mean of individual Weber fractions is biased
/// without bound, their median is not; likelihood-ratio intervals cover 94 % there, the
/// bootstrap's only 74 to 95 %.
struct PsychometricFit {
  FitStatus status = FitStatus::kNotRun;
  /// Why there is no value, or, of a curve whose pse is not > 0, no Weber fraction; else "".
  std::string reason;
  bool is_separated = false;  ///< There is none for answers that are a step: w tends to 0.
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  std::optional<double> weber_fraction;
  /// ml: likelihood ratio, profiled over what else is free, and its ends where
  /// `num_calibration` has them. lsq: the profile of the sum of
  /// squares at F(1, levels - parameters), open where no degree of freedom is left.
  Interval weber_fraction_ci95;
  /// ml: of the observed information, a lapse rate on its bound 0 held there. lsq: of
  /// sse / (levels - parameters) (J^T J)^-1, absent if no degree of freedom is left.
  std::optional<double> standard_error;
  std::optional<double> log_likelihood;  ///< sum k ln f + (n-k) ln(1-f), no binomial terms.
  std::optional<double> deviance;        ///< Twice what the saturated model gains, >= 0.
  /// Probability that answers of this curve lie as far from it; see `answer_scatter.h`. Absent
  /// where no degree of freedom is left, or no interval is asked for.
  std::optional<double> misfit_p_value;
  std::optional<double> pse;
  std::optional<Interval> pse_ci95;  ///< Absent if the pse was not free.
  /// ln pse, test second, less ln pse, test first; with `by_order` alone.
  std::optional<double> order_effect_ln;
  std::optional<double> lapse_rate;
  double guess_rate = 0.0;          ///< The guess rate that was given.
  bool symmetric_lapse = true;      ///< Whether lapses are at both ends.
  std::optional<double> r_squared;  ///< lsq: 1 - sse / sst about the mean proportion.
  BootstrapInterval bootstrap;
  PsychometricFamily family = PsychometricFamily::kWeber;
  struct Parameter {
    std::string_view name;
    double value;
  };
  std::vector<Parameter> parameters;  ///< In the family's own words, beside w, pse and lapse.
  PsychometricCalibration calibration;
  PsychometricOverdispersion overdispersion;
  PsychometricGoodness goodness;
  PsychometricPosterior posterior;
  /// Where an interval above is known to be too narrow, or the value to rest on less than it
  /// seems to, one sentence each.
  std::vector<std::string> warnings;
  int num_levels = 0;           ///< Distinct intensities with trials.
  std::int64_t num_trials = 0;  ///< Over all levels.
};

/// Fits a curve of the family, p(x) = lapse + (1 - 2 lapse) F, or between other ends with
/// guesses: see `PsychometricEnds`. For all of them the pse is where F = 0.5, and F = Phi(1)
/// = 84.13 % at pse (1 + w); for kGauss w is the standard deviation over the pse. kWeber is
/// Phi( ln(x / pse) / ln(1 + w) ), the curve of core::PsychometricFunction, in its slope s = 1
/// / ln(1 + w) > 0: there it is a probit line, whose likelihood has one optimum (Bergmann Tiest
/// et al. 2013 for the curve). Rows of the same intensity are pooled into one level. The
/// optimum is global: least squares, lapses and guesses, which can have several, are searched
/// from a grid.
///
/// `degenerate` exactly where the supremum is not attained, or by more than one curve: at
/// infinite slope (separated), at slope 0 (flat, inverted, all alike), or with
/// fewer levels than it takes to tell the free parameters apart. Of kGauss with a pse that is
/// not > 0 the Weber fraction alone is absent, for it is relative to nothing. A lapse rate on
/// its bound 0 is an optimum. Throws `core::Error` for a reference not > 0, an intensity not
/// finite and >= 0, or counts that are not 0 <= num_yes <= num_trials, rates out of range, or
/// `by_order` with what it does not take. Not real time.
[[nodiscard]] PsychometricFit fit_psychometric(const std::vector<AnswerCount>& data,
                                               const PsychometricOptions& options);

}  // namespace jnd::analysis
