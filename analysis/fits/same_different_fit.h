#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// Two stimuli, "same" or "different": the differencing model (Macmillan and Creelman 2005,
/// ch. 9). What is felt of two stimuli differs by d = ln(x / reference) on average, with
/// standard deviation s; "different" is said where it differs by more than the criterion k to
/// either side:
///
///     P("different" | x) = Phi((-k + d) / s) + Phi((-k - d) / s)
///
/// s is that of a comparison by "more" and "less" with the pse at the reference: so
/// ln(1 + w) = s is the Weber fraction of `core::PsychometricFunction`, which does not depend
/// on how readily "different" is said.
struct SameDifferentFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;                    ///< Why there is no value; "" if there is one.
  std::optional<double> weber_fraction;  ///< exp(s) - 1
  Interval weber_fraction_ci95;          ///< Likelihood ratio, the criterion at its best.
  std::optional<double> criterion_ln;    ///< k, > 0, in ln intensity.
  Interval criterion_ln_ci95;
  std::optional<double> false_alarm_rate;  ///< By the model: 2 Phi(-k / s).
  std::optional<double> log_likelihood;    ///< Without binomial terms.
};

/// By maximum likelihood; `num_yes` counts "different". Pairs that are the same are rows at the
/// reference. `degenerate` where the supremum is not attained: at a step (separated), at one
/// rate for all differences (flat), where all answers agree, or with fewer than two different
/// differences. Throws `core::Error` for a reference or an intensity that is not > 0, or counts
/// that cannot be. Not real time.
[[nodiscard]] SameDifferentFit fit_same_different(const std::vector<AnswerCount>& data,
                                                  double reference);

/// That probability; `spread_ln` > 0.
[[nodiscard]] double different_probability(double intensity, double reference,
                                           double criterion_ln, double spread_ln);

}  // namespace jnd::analysis
