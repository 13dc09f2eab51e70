#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/charts/box_plot.h"
#include "analysis/charts/chart.h"
#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"
#include "analysis/statistics/fit_status.h"
#include "app/operator/background_task.h"

namespace jnd::app {

/// Everything that the results view draws, as plain numbers in SI units and words. Every fitted
/// value and interval is that of `jnd results`.
namespace results {

inline constexpr const char* kEveryone = analysis::kEverybody;

struct Box {
  std::string label;
  analysis::BoxPlot plot;
  struct Outlier {
    std::string participant;
    double value = 0.0;
  };
  std::vector<Outlier> outliers;  ///< Values beyond the whiskers.
  int n = 0;
};

/// Boxes with a common axis: Weber fraction, exponent, matches, stroke width or largest speed
/// by block.
struct BoxFigure {
  std::string name;  ///< Such as "weber_fraction".
  std::string title, unit;
  std::vector<Box> boxes;
};

struct TableColumn {
  std::string title, unit;
};
struct TableRow {
  std::string participant;
  std::vector<std::optional<double>> values;  ///< One for each column.
  std::string note;
};

/// A test between conditions.
struct ComparisonLine {
  std::string name;  ///< Such as "Group D - Group E: ln ln(1 + w), paired".
  std::optional<double> estimate;
  /// Such as "95 % 0.38 to 1.04, t(11) = 4.70, p = 0.0006"; or why there is no estimate.
  std::string detail;
  bool is_primary = false;  ///< Compares blocks by primary values; `detail` names the family.
};

/// One number, with the published value.
struct NumberLine {
  /// In words, such as "Group D" and "Weber fraction".
  std::string section, label;
  std::string name;  ///< Such as "group_d.weber_fraction".
  /// In words; "" for what does not exist.
  std::string value, interval, published;
  std::string meaning;
  /// How the simulated and the published value are related ("calibrated", "implied" or "held
  /// out"), and the tail if it is known.
  std::string basis;
  /// Why the value may be wrong for these data; "" if nothing suggests it.
  std::string caution{};
};

/// A chip that tells how good the data are.
struct QualityChip {
  enum class Tone { kGood, kNeutral, kWarning };
  std::string text;
  Tone tone = Tone::kNeutral;
};

}  // namespace results

struct ResultsModel {
  std::string study, title;
  bool simulated = false;
  std::string citation;  ///< The source of the published values; "" if there are none.
  int num_participants = 0;
  std::vector<analysis::ChartSet> charts;  ///< The report's charts.
  std::vector<results::BoxFigure> boxes;
  std::vector<results::TableColumn> columns;
  std::vector<results::TableRow> rows;
  std::vector<results::ComparisonLine> comparisons;  ///< Primary comparisons come first.
  std::vector<results::NumberLine> numbers;
  std::vector<results::QualityChip> quality;
};

/// Reads the folder and computes everything. It takes seconds for a large study, so call it in
/// a `BackgroundTask`. Throws `core::Error` if the study is double-blind and not unblinded (in
/// the words of every command), if nobody has taken part, or if the study is damaged. Throws
/// `WorkCancelled` between its parts.
[[nodiscard]] ResultsModel results_model(const std::filesystem::path& folder,
                                         WorkControl& control);

// The parts of a `ResultsModel`, without a folder.

/// What was read, its results, and what blocks are called.
struct ResultsSource {
  const analysis::StudyData& data;
  const analysis::StudyResults& results;
  /// Titles by block; a block without one is called by its name.
  std::map<std::string, std::string> titles;
  /// What is asked, by the item's name.
  std::map<std::string, std::string> questions{};

  [[nodiscard]] std::string title(const std::string& block) const;
  /// The sentence with blocks' names replaced by their titles.
  [[nodiscard]] std::string in_titles(std::string sentence) const;
  /// nullptr for a block without results.
  [[nodiscard]] const analysis::ResultsSection* section(const std::string& name) const;
  [[nodiscard]] const analysis::ParticipantEstimate* own(const std::string& section_name,
                                                         const std::string& participant,
                                                         const std::string& estimate) const;
};

[[nodiscard]] std::vector<results::BoxFigure> boxes_of(const ResultsSource& source);
/// `values` are pairs of participant and number; there is at least one.
[[nodiscard]] results::Box box_of(const std::string& label,
                                  const std::vector<std::pair<std::string, double>>& values);
/// Adds the columns and the rows of the participants' table.
void add_table(const ResultsSource& source, ResultsModel& model);

}  // namespace jnd::app
