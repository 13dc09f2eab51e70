#pragma once

#include <string>
#include <vector>

#include "analysis/results/planned_contrasts.h"

namespace jnd::analysis {

/// The conditions with their weights, such as "thin (+1)" and "thick (-1)", or "thin, primed
/// (+0.5)" with groups. Positive weights come first.
[[nodiscard]] std::vector<std::string> condition_words(
    const experiments::ContrastConditions& conditions);

/// What a contrast compares, such as "Weber fraction" or "answer to the question ease", in the
/// language of the report.
[[nodiscard]] std::string said_measure(const experiments::PlannedContrast& plan);

/// For example "The Weber fraction was 2.1 times as large in thin as in thick, 95 % CI
/// [1.6, 2.9], t(12) = 4.10, p = .0015." A sentence on the smallest effect of interest follows
/// if there is one. "" without an effect.
[[nodiscard]] std::string contrast_sentence(const ContrastResult& result);

/// A sentence on when the study was to be looked at and how it ended; "" for a contrast that
/// does not end the study.
[[nodiscard]] std::string looks_sentence(const ContrastResult& result);

/// A p value in the format of journals: "p = .032", "p < .001".
[[nodiscard]] std::string journal_p_words(double p_value);

}  // namespace jnd::analysis
