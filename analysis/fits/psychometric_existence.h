#pragma once

#include <string_view>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Where the supremum of the likelihood lies.
enum class PsychometricSupremum {
  kAttained,      ///< One curve attains it.
  kStep,          ///< It lies at infinite slope, so w falls to 0.
  kFlat,          ///< It lies at slope 0, so w grows without bound.
  kUnidentified,  ///< Many curves are equally likely, or the data are too few to tell.
  /// No curve can give these answers: there is a yes at intensity 0 without lapses.
  kImpossible,
  kNotConverged,
};

/// The kind of supremum with a sentence for people, which is a static string. It is "" if the
/// supremum is attained or the search did not converge.
struct PsychometricExistence {
  PsychometricSupremum supremum = PsychometricSupremum::kNotConverged;
  std::string_view reason;
};

inline constexpr std::string_view kYesAtZero =
    "impossible: a yes at intensity 0 has probability 0 without lapses";

/// Why the levels cannot identify the free parameters, whatever the answers are; "" if they
/// can.
[[nodiscard]] std::string_view why_unidentified(const PsychometricLevels& levels, bool free_pse,
                                                bool free_lapse);

/// Decides exactly, from the counts alone, whether maximum likelihood without lapses and
/// guesses has an optimum. The log-likelihood is concave (Albert and Anderson 1984). The levels
/// must identify the parameters.
[[nodiscard]] PsychometricExistence existence_from_counts(const PsychometricLevels& levels,
                                                          bool free_pse);

/// The limit, step or flat line, to which the cost falls if it has no minimum below both
/// limits. The levels must identify the parameters.
[[nodiscard]] PsychometricExistence lower_limit(const PsychometricLevels& levels, bool free_pse,
                                                double step_cost, double flat_cost);

/// How much the answers rise along the levels, in trials: the sum of (num_yes - expected)
/// abscissa. It is at most 0 if they do not rise.
[[nodiscard]] double rise_of_answers(const PsychometricLevels& levels, bool free_pse) noexcept;

}  // namespace jnd::analysis
