#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/results/predictive_people.h"
#include "analysis/results/study_results.h"

namespace jnd::app {

/// The results of a study folder, with the published values that the program ships. If the
/// study was simulated in a shipped laboratory, they include what studies of simulated people
/// find.
[[nodiscard]] analysis::StudyResults results_of_folder(
    const std::filesystem::path& folder, const analysis::ResultsOptions& options = {});

/// The results of data that were read already; the caller decides whether they may be seen.
/// `people` of the same study and laboratory replace the shipped ones.
[[nodiscard]] analysis::StudyResults results_of_data(
    const analysis::StudyData& data, const analysis::ResultsOptions& options = {},
    const analysis::PredictivePeople* people = nullptr);

/// The results as the JSON that docs/reference/json.md describes: study, simulated, sections.
[[nodiscard]] nlohmann::json results_json(const analysis::StudyResults& results);

/// Every estimate with its interval and published value, one table for each section.
[[nodiscard]] std::string to_table(const analysis::StudyResults& results);

/// Only estimates with a published value: ours beside the published one and, if there are
/// simulated studies, their values and the share of them that is as far out. Values on which
/// the laboratory was calibrated come first, then those that were held out.
[[nodiscard]] std::string to_comparison_table(const analysis::StudyResults& results);

}  // namespace jnd::app
