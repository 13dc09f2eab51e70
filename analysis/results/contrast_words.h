#pragma once

#include <string>
#include <vector>

#include "analysis/results/planned_contrasts.h"

namespace jnd::analysis {

/// "thin (+1)", "thick (-1)", of groups "thin, primed (+0.5)": those above 0 first.
[[nodiscard]] std::vector<std::string> condition_words(
    const experiments::ContrastConditions& conditions);

/// "The Weber fraction was 2.1 times as large in thin as in thick, 95 % CI [1.6, 2.9], t(12) =
/// 4.10, p = .0015." With what the smallest effect of interest says. "" without an effect.
[[nodiscard]] std::string contrast_sentence(const ContrastResult& result);

/// When the study was to be looked at and how it ended; "" of a contrast that ends none.
[[nodiscard]] std::string looks_sentence(const ContrastResult& result);

/// As journals print it: "p = .032", "p < .001".
[[nodiscard]] std::string journal_p_words(double p_value);

}  // namespace jnd::analysis
