#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/fits/fit_status.h"

namespace jnd::analysis {

/// How often "more than the reference" was answered at one intensity.
struct AnswerCount {
  double intensity = 0.0;       ///< >= 0; at 0 the curve is at its lower asymptote.
  std::int64_t num_yes = 0;     ///< 0 .. num_trials
  std::int64_t num_trials = 0;  ///< >= 0; a row without trials says nothing.
};

enum class PsychometricMethod {
  kMaximumLikelihood,  ///< "ml"
  kLeastSquares,       ///< "lsq": one unweighted term per level, as the thesis fits.
};

[[nodiscard]] constexpr std::string_view to_string(PsychometricMethod method) noexcept {
  return method == PsychometricMethod::kMaximumLikelihood ? "ml" : "lsq";
}

struct PsychometricOptions {
  double reference = 0.0;  ///< > 0, unit of the intensities. The pse, unless that is free.
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  bool free_pse = false;
  bool free_lapse = false;
  int num_bootstrap = 0;   ///< Refits of the bootstrap; 0 leaves it out.
  std::uint64_t seed = 1;  ///< Of the bootstrap: the same seed gives the same interval.
  bool intervals = true;   ///< False leaves out the profile intervals, where only w is wanted.
  Solver solver = Solver::kCeres;
};

/// Percentile interval of the Weber fraction over data redrawn from the fitted curve.
struct BootstrapInterval {
  int n = 0;               ///< Refits asked for.
  int num_degenerate = 0;  ///< Of these, refits without an optimum, counted at their limit.
  Interval ci95;           ///< An end among refits without an optimum is open.
  std::string method;      ///< "" if none was asked for.
};

/// A fitted psychometric function, with the words of the JSON output. Where `status` is not
/// kOk no number is given, however plausible one would look.
///
/// What the intervals assume: answers independent and binomial at each level, and the curve
/// right. A drifting criterion or lapses left out of the model make them too narrow. At five
/// trials a level the mean of individual Weber fractions is biased without bound, their median
/// is not; likelihood-ratio intervals cover 95 % there, the bootstrap's only 79 to 93 %.
struct PsychometricFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no value; "" if there is one.
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  std::optional<double> weber_fraction;
  /// ml: likelihood ratio, profiled over what else is free. lsq: the profile of the sum of
  /// squares at F(1, levels - parameters), open where no degree of freedom is left.
  Interval weber_fraction_ci95;
  /// ml: of the observed information, a lapse rate on its bound 0 held there. lsq: of
  /// sse / (levels - parameters) (J^T J)^-1, absent if no degree of freedom is left.
  std::optional<double> standard_error;
  std::optional<double> log_likelihood;  ///< sum k ln f + (n-k) ln(1-f), no binomial terms.
  std::optional<double> deviance;        ///< Twice what the saturated model gains, >= 0.
  std::optional<double> pse;
  std::optional<Interval> pse_ci95;  ///< Absent if the pse was not free.
  std::optional<double> lapse_rate;
  std::optional<double> r_squared;  ///< lsq: 1 - sse / sst about the mean proportion.
  BootstrapInterval bootstrap;
  int num_levels = 0;           ///< Distinct intensities with trials.
  std::int64_t num_trials = 0;  ///< Over all levels.
};

/// Fits p(x) = lapse + (1 - 2 lapse) Phi( ln(x / pse) / ln(1 + w) ), the curve of
/// core::PsychometricFunction, in its slope s = 1 / ln(1 + w) > 0: there it is a probit line,
/// whose likelihood has one optimum (Bergmann Tiest et al. 2013 for the curve). Rows of the
/// same intensity are pooled into one level. The optimum is global: least squares and free
/// lapses, which can have several, are searched from a grid.
///
/// `degenerate` exactly where the supremum is not attained, or by more than one curve: at
/// infinite slope (separated), at slope 0 (flat, inverted), or with fewer levels than it takes
/// to tell the free parameters apart. A lapse rate on its bound 0 is an optimum.
/// Throws `core::Error` for a reference not > 0, an intensity not finite and >= 0, or counts
/// that are not 0 <= num_yes <= num_trials. Not real time.
[[nodiscard]] PsychometricFit fit_psychometric(const std::vector<AnswerCount>& data,
                                               const PsychometricOptions& options);

}  // namespace jnd::analysis
