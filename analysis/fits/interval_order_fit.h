#pragma once

#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Whether the rows distinguish trials with the test in the first interval from trials with the
/// test in the second.
[[nodiscard]] bool orders_vary(const std::vector<AnswerCount>& data) noexcept;

/// Fits the Weber curve for trials in which either interval may hold the test:
///
///     P(test chosen) = Phi( ln(x / pse_o) / ln(1 + w) ),   ln pse_o = ln pse + o q
///
/// Here o is `AnswerCount::order`, and q is the order effect. A person who favours one interval
/// has two pses whose logarithms differ by q. The orders must not be pooled, because the mean
/// of the two curves is flatter than either and gives too large a Weber fraction (Ulrich and
/// Vorberg 2009). q is always free; the pse is free if `free_pse` is set. The fit is a concave
/// probit regression by maximum likelihood with likelihood-ratio intervals. It uses the options
/// `reference`, `free_pse`, `intervals`, `num_calibration` (for any number of answers),
/// `num_goodness` with `diagnostics`, and `seed`. `fit_psychometric` says when it calls this
/// function, when the status is `degenerate`, and what is thrown. Not real time.
[[nodiscard]] PsychometricFit fit_by_interval_order(const std::vector<AnswerCount>& data,
                                                    const PsychometricOptions& options);

/// P(test chosen), averaged over both orders. A figure shows it where its points pool the
/// orders. With an `order_effect_ln` of 0 it is the curve itself.
[[nodiscard]] double mean_over_orders(double pse, double weber_fraction, double order_effect_ln,
                                      double intensity) noexcept;

}  // namespace jnd::analysis
