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

/// The columns that the formulas name, each once, in the order of their first places.
[[nodiscard]] std::vector<std::string> columns_of(const MixedFormulas& formulas);

/// The formula that names this column, pointing at it: for a column that the table has not.
[[nodiscard]] FormulaError unknown_in(const MixedFormulas& formulas, const std::string& column,
                                      const std::string& known);

/// What `add_history` calls the stimulus before: "previous_u".
[[nodiscard]] std::string previous_stimulus(const std::string& stimulus);
inline constexpr const char* kPreviousAnswer = "previous_answer";

/// Gives each row the stimulus and the answer (0 or 1) of the row before it of the same person,
/// as columns `previous_STIMULUS` and `previous_answer`, and leaves out each person's first
/// row, which has none before it. Returns how many those are. Throws `core::Error` where a row
/// is more than one trial.
std::size_t add_history(TrialTable& table, const std::string& stimulus,
                        const std::string& person);

/// A fixed effect that people could differ in, and may not in this model.
struct EffectOfAll {
  std::string effect, column, group;  ///< `effect` and `group`: as R names them.
};

/// Columns of the fixed effects that have several values within a group of a random term, and
/// none of whose random effects. Where people do differ in such an effect, its standard error
/// is too small (Barr et al. 2013).
[[nodiscard]] std::vector<EffectOfAll> effects_of_all(const MixedFormulas& formulas,
                                                      const TrialTable& table);

/// Answers and matrices of the formulas over the rows of the table. `fixed` is the design of
/// the fixed effects. Throws as `Design`; `core::Error` where there is no random term.
[[nodiscard]] MixedData mixed_data(const MixedFormulas& formulas, const Design& fixed,
                                   const TrialTable& table, Contrasts contrasts);

}  // namespace jnd::analysis
