#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Returns a forced-choice chance of 1/2, 1/3 or 1/4 if the counts look like proportions
/// correct with that chance although they were given as yes-no answers. Returns nothing
/// otherwise. A chance is suspected if both conditions hold:
///
/// - No level lies below the chance, apart from noise. The best rising curve (isotonic
///   regression) that stays at or above the chance loses, against the best rising curve of all,
///   no more than the 95 % quantile of chi-squared with one degree of freedom.
/// - Curves guess + (1 - guess - lapse) F(ln x) from this chance suit the answers: they are
///   twenty times as likely as curves from 0. In staircases, which hardly ask below the
///   threshold, the likelihoods may not tell. It then suffices that the likelihood is at least
///   e^-0.5 times that from 0 for 1/2, or e times for 1/3 and 1/4, and that right answers are
///   many: their share is at least 0.68 (0.62 for 1/3 and 1/4) and above one half
///   (binomial, 10 %). Yes-no answers with the reference among the levels are yes in only about
///   half of the trials.
///
/// If several chances qualify, the largest is returned. Data that cannot be told apart from a
/// forced choice, such as yes-no answers only to levels above the reference, are suspected too.
/// If there are more than 60 levels, neighbours are pooled. Not real time.
[[nodiscard]] std::optional<double> suspected_chance(const std::vector<AnswerCount>& rows);

/// A warning about the suspected chance: one sentence that names the option `--guess`.
[[nodiscard]] std::string chance_warning(double chance);

}  // namespace jnd::analysis
