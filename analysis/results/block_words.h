#pragma once

#include <string>
#include <vector>

#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// For example "1, 2, 4 Pa s".
[[nodiscard]] std::string list_of(const std::vector<double>& values, const std::string& unit);

/// Whether the answers decide how many trials the block has, so that the number of trials is
/// only an expectation.
[[nodiscard]] bool length_is_expected(const experiments::Block& block);

/// For example "40", or "about 40" if that is only expected.
[[nodiscard]] std::string trials_to_expect(const experiments::Block& block, int num_trials);

/// For example "0.5". For an adjustment it is the starting intensity. A matching has the
/// standard first, as in "8 (from 0.5)".
[[nodiscard]] std::string stimulus_words(const experiments::PlannedTrial& trial);

/// What an adaptive block does, without its levels: "2 staircases, 1 up 2 down, each to 10
/// reversals or 60 trials", "8 series over 10 levels", "QUEST+ over 12 levels".
[[nodiscard]] std::string adaptive_words(const experiments::Block& block);

/// The levels of the block, one line each: "from 1 to 30 Pa s", "starting at 16, 4 Pa s".
[[nodiscard]] std::vector<std::string> adaptive_level_words(const experiments::Block& block,
                                                            const std::string& unit);

/// The whole design in one line, as the methods section of a report needs it.
[[nodiscard]] std::string adaptive_design_words(const experiments::Block& block,
                                                const std::string& unit);

}  // namespace jnd::analysis
