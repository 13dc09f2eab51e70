#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/results/predictive_people.h"
#include "analysis/results/study_results.h"

namespace jnd::app {

/// Results of a study folder, with the published values that are shipped and, where it was
/// simulated in a shipped laboratory, what studies of simulated people come to.
[[nodiscard]] analysis::StudyResults results_of_folder(
    const std::filesystem::path& folder, const analysis::ResultsOptions& options = {});

/// The same of what was read from a folder already; whether it may be seen is the caller's.
/// `people`: of that study and laboratory, in place of those that are shipped.
[[nodiscard]] analysis::StudyResults results_of_data(
    const analysis::StudyData& data, const analysis::ResultsOptions& options = {},
    const analysis::PredictivePeople* people = nullptr);

/// The contract's JSON: study, simulated, sections.
[[nodiscard]] nlohmann::json results_json(const analysis::StudyResults& results);

/// Every estimate with interval and published value, a table a section.
[[nodiscard]] std::string to_table(const analysis::StudyResults& results);

/// Only what has a published value: ours beside it and, where they are known, what simulated
/// studies come to, with the share of them as far out; first what the laboratory was calibrated
/// on, then what was held out.
[[nodiscard]] std::string to_comparison_table(const analysis::StudyResults& results);

}  // namespace jnd::app
