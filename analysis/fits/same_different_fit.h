#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The differencing model of answers "same" or "different" to two stimuli (Macmillan and
/// Creelman 2005, ch. 9). The felt difference has mean d = ln(x / reference) and standard
/// deviation s. The person says "different" if it exceeds the criterion k to either side:
///
///     P("different" | x) = Phi((-k + d) / s) + Phi((-k - d) / s)
///
/// s is also the spread of comparisons by "more" and "less" with the pse at the reference. So
/// ln(1 + w) = s gives the Weber fraction of `core::PsychometricFunction`, which does not
/// depend on how readily the person says "different".
struct SameDifferentFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;                    ///< Why there is no value; "" if there is one.
  std::optional<double> weber_fraction;  ///< exp(s) - 1
  /// The likelihood-ratio interval, with the criterion at its optimum.
  Interval weber_fraction_ci95;
  std::optional<double> criterion_ln;  ///< The criterion k in ln intensity, > 0.
  Interval criterion_ln_ci95;
  /// The rate that follows from the model: 2 Phi(-k / s).
  std::optional<double> false_alarm_rate;
  /// The log-likelihood without binomial coefficients.
  std::optional<double> log_likelihood;
};

/// Fits by maximum likelihood. `num_yes` counts the answers "different". Pairs of equal stimuli
/// are rows at the reference. The status is `degenerate` if the supremum of the likelihood is
/// not attained: at a step (separated answers), at one rate for all differences (flat), if all
/// answers agree, or if there are fewer than two different differences. Throws `core::Error`
/// for a reference or an intensity that is not > 0, and for impossible counts. Not real time.
[[nodiscard]] SameDifferentFit fit_same_different(const std::vector<AnswerCount>& data,
                                                  double reference);

/// P("different" | x) of the model. `spread_ln` is > 0.
[[nodiscard]] double different_probability(double intensity, double reference,
                                           double criterion_ln, double spread_ln);

}  // namespace jnd::analysis
