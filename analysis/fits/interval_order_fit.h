#pragma once

#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Whether the rows tell apart trials with the test in the first and in the second interval.
[[nodiscard]] bool orders_vary(const std::vector<AnswerCount>& data) noexcept;

/// The Weber curve where either interval may hold the test,
///
///     P(test chosen) = Phi( ln(x / pse_o) / ln(1 + w) ),   ln pse_o = ln pse + o q
///
/// with o of `AnswerCount::order`. Who favours one interval has pses that lie apart by q, the
/// order effect (Ulrich and Vorberg 2009 on why the orders must not be pooled: the mean of two
/// curves is flatter than either, and its Weber fraction too large). q is always free, the pse
/// if `free_pse`. Maximum likelihood by a concave probit regression; intervals by the
/// likelihood ratio. Takes of the options `reference`, `free_pse`, `intervals`,
/// `num_calibration`, whatever the number of answers, `num_goodness` with `diagnostics`, and
/// `seed`; `fit_psychometric` says when it comes here, what is `degenerate`, and what is
/// thrown. Not real time.
[[nodiscard]] PsychometricFit fit_by_interval_order(const std::vector<AnswerCount>& data,
                                                    const PsychometricOptions& options);

/// P(test chosen) of such a curve, the mean of both orders: what the points of a figure show
/// that has them together. `order_effect_ln` 0: the curve itself.
[[nodiscard]] double mean_over_orders(double pse, double weber_fraction, double order_effect_ln,
                                      double intensity) noexcept;

}  // namespace jnd::analysis
