#pragma once

#include <string>
#include <vector>

#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// "1, 2, 4 Pa s".
[[nodiscard]] std::string list_of(const std::vector<double>& values, const std::string& unit);

/// Whether the answers decide how many trials the block has, so that their number is one to
/// expect and no more.
[[nodiscard]] bool length_is_expected(const experiments::Block& block);

/// "40", or "about 40" where that is only expected.
[[nodiscard]] std::string trials_to_expect(const experiments::Block& block, int num_trials);

/// "0.5", of an adjustment where it starts; of a matching "8 (from 0.5)", the standard first.
[[nodiscard]] std::string stimulus_words(const experiments::PlannedTrial& trial);

/// What an adaptive block does, without a level: "2 staircases, 1 up 2 down, each to 10
/// reversals or 60 trials", "8 series over 10 levels", "QUEST+ over 12 levels".
[[nodiscard]] std::string adaptive_words(const experiments::Block& block);

/// Where its levels lie, a line each: "from 1 to 30 Pa s", "starting at 16, 4 Pa s".
[[nodiscard]] std::vector<std::string> adaptive_level_words(const experiments::Block& block,
                                                            const std::string& unit);

/// All of it in one line, as a report's methods have it.
[[nodiscard]] std::string adaptive_design_words(const experiments::Block& block,
                                                const std::string& unit);

}  // namespace jnd::analysis
