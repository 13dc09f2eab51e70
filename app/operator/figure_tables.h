#pragma once

#include <filesystem>

#include "app/operator/results_model.h"

namespace jnd::app {

/// Writes what each figure draws as BLOCK_answers.csv, BLOCK_curves.csv, BLOCK_means.csv,
/// BLOCK_power_laws.csv and boxes.csv, so that it can be drawn again elsewhere. Returns how
/// many files that are. Throws `core::Error`. Not real time.
int write_figure_tables(const ResultsModel& model, const std::filesystem::path& folder);

}  // namespace jnd::app
