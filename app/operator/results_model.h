#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/charts/chart.h"
#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"
#include "analysis/statistics/fit_status.h"
#include "app/operator/background_task.h"

namespace jnd::app {

/// Everything that the results view draws, as plain numbers in SI units and words. Every fitted
/// value and interval is the one of `jnd results`.
namespace results {

struct Point {
  double x = 0.0, y = 0.0;
};

/// An x with the range that a curve may lie in there.
struct BandPoint {
  double x = 0.0, low = 0.0, high = 0.0;
};

inline constexpr const char* kEveryone = analysis::kEverybody;

/// Where curves are sampled, evenly in the logarithm as intensities are drawn; 0 < low < high.
[[nodiscard]] std::vector<double> logarithmic_grid(double low, double high);

/// How often "more than the reference" was answered at one intensity.
struct Proportion {
  double intensity = 0.0;
  double ratio = 0.0;
  double low = 0.0, high = 0.0;  ///< Wilson's 95 % interval; takes the answers for independent.
  std::int64_t num_yes = 0, num_trials = 0;
};

/// Answers of one participant, or of all, and the curve of the primary value: of all that of
/// the median person, of one their own with the pse of the primary value.
struct PsychometricFigure {
  std::string who;  ///< "P01"; "all participants".
  std::vector<Proportion> points;
  std::optional<double> weber_fraction;  ///< The primary value.
  analysis::Interval ci95;
  double pse = 0.0;              ///< Where the curve is at 50 %; unit of the quantity.
  double lapse_rate = 0.0;       ///< Of everybody.
  double order_effect_ln = 0.0;  ///< Where either interval may hold the test; else 0.
  std::string reason;            ///< Why there is no curve; "" if there is one.
  std::vector<Point> curve;
  /// Between the curves with the ends of `ci95` for the Weber fraction, the pse held, where
  /// both meet. An open end is a step, or a flat line.
  std::vector<BandPoint> band;
  /// pse (1 + w): answered "more" in 84 %. None with an order effect.
  std::optional<double> weber_line;
  /// Of all: one curve through everybody's answers, which differences between people flatten.
  std::vector<Point> pooled_curve;
  /// Other values, each named as what it is: "pooled curve 0.70", "published 0.697".
  std::vector<std::string> others;
  std::vector<std::string> cautions;  ///< Why the value may be wrong, a sentence each.
};

/// A block with a reference.
struct Discrimination {
  std::string block, title;
  std::string quantity, unit;    ///< "viscosity", "Pa s".
  std::string answer;            ///< "“yes”", "test chosen".
  bool has_fixed_levels = true;  ///< Else so many that each has few answers.
  double reference = 0.0;
  bool has_free_pse = false;  ///< Of the primary value; else it is at the reference.
  PsychometricFigure pooled;  ///< Everybody's.
  /// By maximum likelihood, with likelihood-ratio intervals; by pseudonym.
  std::vector<PsychometricFigure> participants;
};

/// A mean with its spread, over the participants or one participant's answers.
struct Mean {
  double at = 0.0;  ///< Estimation: the intensity. Production: the target's ratio.
  double arithmetic = 0.0, arithmetic_low = 0.0, arithmetic_high = 0.0;  ///< One sd.
  /// Absent where a value is 0 or less. The range is one standard deviation of the logarithms.
  std::optional<double> geometric, geometric_low, geometric_high;
  int n = 0;
};

/// magnitude = k intensity^a
struct PowerCurve {
  std::string name;  ///< "magnitude_estimation", as estimates are named.
  std::optional<double> k, a;
  analysis::Interval k_ci95, a_ci95;
  std::optional<double> published_k, published_a;
  std::string reason;        ///< Why there is none; "" if there is one.
  std::vector<Point> curve;  ///< Intensity and magnitude, both > 0, for a log-log plot.
};

struct MagnitudeFigure {
  std::string who;
  std::vector<Mean> estimation;  ///< Means of magnitudes at intensities.
  std::vector<Mean> production;  ///< Means of intensities at magnitudes.
  std::optional<PowerCurve> estimation_curve, production_curve, combined_curve;
};

/// Estimation and production of one quantity, or one of them.
struct Magnitude {
  std::string title;
  std::string quantity, unit;
  std::string estimation_block, production_block;  ///< "" without.
  MagnitudeFigure pooled;                          ///< Every participant weighs the same.
  std::vector<MagnitudeFigure> participants;
};

/// Quartiles by linear interpolation; whiskers reach to the last value within 1.5 interquartile
/// ranges of the box (Tukey 1977).
struct Box {
  std::string label;
  double median = 0.0, lower_quartile = 0.0, upper_quartile = 0.0;
  double lower_whisker = 0.0, upper_whisker = 0.0;
  struct Outlier {
    std::string participant;
    double value = 0.0;
  };
  std::vector<Outlier> outliers;
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
  std::vector<results::Discrimination> discriminations;
  std::vector<analysis::ChartSet> charts;  ///< Those of the report.
  std::vector<results::Magnitude> magnitudes;
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
  std::map<std::string, std::string> titles;  ///< By block; its name where there is none.

  [[nodiscard]] std::string title(const std::string& block) const;
  /// A sentence with the titles of blocks in place of their names.
  [[nodiscard]] std::string in_titles(std::string sentence) const;
  /// Nothing for a block without results.
  [[nodiscard]] const analysis::ResultsSection* section(const std::string& name) const;
  [[nodiscard]] const analysis::ParticipantEstimate* own(const std::string& section_name,
                                                         const std::string& participant,
                                                         const std::string& estimate) const;
};

[[nodiscard]] std::vector<results::Discrimination> discriminations_of(
    const ResultsSource& source);
[[nodiscard]] std::vector<results::Magnitude> magnitudes_of(const ResultsSource& source);
[[nodiscard]] std::vector<results::BoxFigure> boxes_of(const ResultsSource& source);
/// `values`: participant and number, at least one.
[[nodiscard]] results::Box box_of(const std::string& label,
                                  const std::vector<std::pair<std::string, double>>& values);
/// Columns and rows of the participants' table.
void add_table(const ResultsSource& source, ResultsModel& model);

}  // namespace jnd::app
