#pragma once

#include <string>
#include <vector>

#include "analysis/data/trial_table.h"
#include "analysis/mixed/design.h"
#include "analysis/mixed/formula.h"
#include "analysis/mixed/mixed_fit.h"

namespace jnd::analysis {

/// The formulas of one model.
struct MixedFormulas {
  Formula fixed;
  std::vector<RandomTerm> random;
};

/// The columns that the formulas name, without repetition, in the order in which they first
/// appear.
[[nodiscard]] std::vector<std::string> columns_of(const MixedFormulas& formulas);

/// An error that points at the unknown column in the formula that names it.
[[nodiscard]] FormulaError unknown_in(const MixedFormulas& formulas, const std::string& column,
                                      const std::string& known);

/// The name that `add_history` gives to the previous stimulus: "previous_u".
[[nodiscard]] std::string previous_stimulus(const std::string& stimulus);
inline constexpr const char* kPreviousAnswer = "previous_answer";

/// Gives each row the stimulus and the answer (0 or 1) of the same person's row before it, as
/// columns `previous_STIMULUS` and `previous_answer`. It removes each person's first row and
/// returns the number of removed rows. Throws `core::Error` if a row holds more than one trial.
std::size_t add_history(TrialTable& table, const std::string& stimulus,
                        const std::string& person);

/// A fixed effect in which people could differ, but may not in this model.
struct EffectOfAll {
  std::string effect, column, group;  ///< `effect` and `group` are named as in R.
};

/// Columns of the fixed effects that vary within the groups of a random term but have no random
/// effect there. If people do differ in such an effect, its standard error is too small (Barr
/// et al. 2013).
[[nodiscard]] std::vector<EffectOfAll> effects_of_all(const MixedFormulas& formulas,
                                                      const TrialTable& table);

/// The answers and matrices of the formulas over the rows of the table. `fixed` is the design
/// of the fixed effects. Throws as `Design` does, and `core::Error` if there is no random term.
[[nodiscard]] MixedData mixed_data(const MixedFormulas& formulas, const Design& fixed,
                                   const TrialTable& table, Contrasts contrasts);

}  // namespace jnd::analysis
