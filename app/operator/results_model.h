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
/// value and interval is the one of `jnd results`.
namespace results {

inline constexpr const char* kEveryone = analysis::kEverybody;

struct Box {
  std::string label;
  analysis::BoxPlot plot;
  struct Outlier {
    std::string participant;
    double value = 0.0;
  };
  std::vector<Outlier> outliers;  ///< Beyond the whiskers.
  int n = 0;
};

/// Boxes that share an axis: Weber fraction, exponent, matches, stroke width or largest speed
/// by block.
struct BoxFigure {
  std::string name;  ///< "weber_fraction"
  std::string title, unit;
  std::vector<Box> boxes;
};

struct TableColumn {
  std::string title, unit;
};
struct TableRow {
  std::string participant;
  std::vector<std::optional<double>> values;  ///< One a column.
  std::string note;
};

/// A test between conditions.
struct ComparisonLine {
  std::string name;  ///< "Group D - Group E: ln ln(1 + w), paired"
  std::optional<double> estimate;
  std::string detail;  ///< "95 % 0.38 to 1.04, t(11) = 4.70, p = 0.0006"; or why there is none.
  bool is_primary =
      false;  ///< Between blocks, by their primary values; `detail` has its family.
};

/// One number with what was published.
struct NumberLine {
  std::string section, label;              ///< In words: "Group D", "Weber fraction".
  std::string name;                        ///< "group_d.weber_fraction"
  std::string value, interval, published;  ///< In words; "" for what there is not.
  std::string meaning;
  /// Simulated and published: "calibrated", "implied", "held out"; and the tail, where known.
  std::string basis;
  std::string caution{};  ///< Why it may be wrong for these data; "" where nothing says so.
};

/// A chip: how good the data are.
struct QualityChip {
  enum class Tone { kGood, kNeutral, kWarning };
  std::string text;
  Tone tone = Tone::kNeutral;
};

}  // namespace results

struct ResultsModel {
  std::string study, title;
  bool simulated = false;
  std::string citation;  ///< Of the published values; "" without any.
  int num_participants = 0;
  std::vector<analysis::ChartSet> charts;  ///< Those of the report.
  std::vector<results::BoxFigure> boxes;
  std::vector<results::TableColumn> columns;
  std::vector<results::TableRow> rows;
  std::vector<results::ComparisonLine> comparisons;  ///< Primary ones first.
  std::vector<results::NumberLine> numbers;
  std::vector<results::QualityChip> quality;
};

/// Reads the folder and computes everything; seconds for a large study, so for a
/// `BackgroundTask`. Throws `core::Error`: double-blind and not unblinded, in the words of
/// every command; nobody has taken part; damaged. `WorkCancelled` between its parts.
[[nodiscard]] ResultsModel results_model(const std::filesystem::path& folder,
                                         WorkControl& control);

// Its parts, without a folder.

/// What was read, what it comes to, and what blocks are called.
struct ResultsSource {
  const analysis::StudyData& data;
  const analysis::StudyResults& results;
  std::map<std::string, std::string> titles;       ///< By block; its name where there is none.
  std::map<std::string, std::string> questions{};  ///< What is asked, by the name of the item.

  [[nodiscard]] std::string title(const std::string& block) const;
  /// A sentence with the titles of blocks in place of their names.
  [[nodiscard]] std::string in_titles(std::string sentence) const;
  /// Nothing for a block without results.
  [[nodiscard]] const analysis::ResultsSection* section(const std::string& name) const;
  [[nodiscard]] const analysis::ParticipantEstimate* own(const std::string& section_name,
                                                         const std::string& participant,
                                                         const std::string& estimate) const;
};

[[nodiscard]] std::vector<results::BoxFigure> boxes_of(const ResultsSource& source);
/// `values`: participant and number, at least one.
[[nodiscard]] results::Box box_of(const std::string& label,
                                  const std::vector<std::pair<std::string, double>>& values);
/// Columns and rows of the participants' table.
void add_table(const ResultsSource& source, ResultsModel& model);

}  // namespace jnd::app
