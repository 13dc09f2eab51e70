#pragma once

#include <string_view>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Where the supremum of the likelihood lies.
enum class PsychometricSupremum {
  kAttained,      ///< At one curve.
  kStep,          ///< At infinite slope: w falls to 0.
  kFlat,          ///< At slope 0: w grows without bound.
  kUnidentified,  ///< At many curves alike, or for want of data nowhere in particular.
  kImpossible,    ///< No curve gives these answers: a yes at intensity 0 without lapses.
  kNotConverged,
};

/// With a sentence for people, static; "" if the supremum is attained or was not reached.
struct PsychometricExistence {
  PsychometricSupremum supremum = PsychometricSupremum::kNotConverged;
  std::string_view reason;
};

inline constexpr std::string_view kYesAtZero =
    "impossible: a yes at intensity 0 has probability 0 without lapses";

/// Why the levels alone, whatever the answers, cannot identify the free parameters; "" if they
/// can.
[[nodiscard]] std::string_view why_unidentified(const PsychometricLevels& levels, bool free_pse,
                                                bool free_lapse);

/// Whether maximum likelihood without lapses and guesses has an optimum, exactly, from the
/// counts alone: it is concave (Albert and Anderson 1984). For levels that identify.
[[nodiscard]] PsychometricExistence existence_from_counts(const PsychometricLevels& levels,
                                                          bool free_pse);

/// Which limit the cost falls to where it has no minimum below both. For levels that identify.
[[nodiscard]] PsychometricExistence lower_limit(const PsychometricLevels& levels, bool free_pse,
                                                double step_cost, double flat_cost);

/// Rise of the answers along the levels, in trials: sum of (num_yes - expected) abscissa. At
/// most 0 if they do not rise.
[[nodiscard]] double rise_of_answers(const PsychometricLevels& levels, bool free_pse) noexcept;

}  // namespace jnd::analysis
