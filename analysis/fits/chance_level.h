#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// The chance of a forced choice, 1/2, 1/3 or 1/4, that the counts look like proportions
/// correct of, though they were given as answers of yes and no; nothing where they do not. All
/// of:
///
/// - No level lies below the chance, noise aside: the best rising curve (isotonic regression)
///   that stays at or above it is not worse than the best of all by more than the 95 % quantile
///   of chi-squared with one degree of freedom.
/// - Curves guess + (1 - guess - lapse) F(ln x) from this chance suit the answers: their
///   likelihood is twenty times that of curves from 0. Or, as in staircases, which hardly ask
///   below the threshold, the likelihoods do not tell (of 1/2: at least e^-0.5 times that from
///   0; of 1/3 and 1/4: e times), and right answers are many: a share of at least 0.68 (0.62)
///   that is above one half (binomial, 10 %). Answers of yes and no about a reference among the
///   levels are yes in about half.
///
/// Of several chances the largest. What can not be told apart, such as answers of yes and no to
/// levels above the reference alone, is suspected, too. Levels beyond 60 are pooled with their
/// neighbours. Not real time.
[[nodiscard]] std::optional<double> suspected_chance(const std::vector<AnswerCount>& rows);

/// What to say of it: one sentence that names the option `--guess`.
[[nodiscard]] std::string chance_warning(double chance);

}  // namespace jnd::analysis
