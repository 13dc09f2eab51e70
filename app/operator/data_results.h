#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/charts/figure_table.h"
#include "app/curves/curve_analysis.h"

namespace jnd::app {

// The curves of somebody's table, in the words and numbers that are shown. They are the ones
// that `jnd fit psychometric` prints.

struct DataValue {
  std::string value;     ///< The value, such as "12.3"; "-" if there is none.
  std::string interval;  ///< The interval, such as "10.1 to 14.2"; "" if there is none.
};

/// One of the numbers of a curve.
struct DataNumber {
  std::string name;  ///< The name, such as "PSE" or "threshold 0.75".
  DataValue number;
  std::string remark;  ///< What it means, such as "where the curve is half way up".
};

/// A group of answers and its curve.
struct DataGroup {
  std::string name;  ///< The name, such as "condition light"; "all rows" if there is one group.
  std::int64_t num_trials = 0;
  std::string reason;  ///< Why there is no curve; "" if there is one.
  DataValue location, scale, pse, jnd;
  std::vector<DataValue> thresholds;  ///< In the order of `DataResults::levels`.
  std::string deviance;
  std::vector<DataNumber> numbers;  ///< Every number of the curve.
  std::vector<std::string> cautions;
};

/// The results of the fits.
struct DataResults {
  std::string formula;         ///< Such as "rising curve 1 / (1 + exp(...))".
  std::string title;           ///< Such as "Fits, with 95 % by the likelihood ratio".
  std::vector<double> levels;  ///< The levels of the thresholds.
  std::vector<DataGroup> groups;
  /// As from `picture_tables`; they name the groups by number.
  std::vector<analysis::FigureTable> tables;
  bool is_logarithmic = false;
  std::optional<double> chance;    ///< The guess rate, if it is known and above 0.
  std::string x_title, y_title;    ///< Such as "delay_ms" and "percent of num_first".
  std::vector<std::string> notes;  ///< What was left out or added up, one sentence each.
  /// The answers look like right answers of a forced choice among so many alternatives, but
  /// nobody said what the task was. Nothing is fitted until somebody does.
  std::optional<int> suspected_alternatives;
};

/// A sentence such as "The location differs: ...", and whether it was found to differ.
struct DataVerdict {
  std::string sentence;
  bool differs = false;
};

/// The thresholds of two groups: the second minus the first, and the second divided by the
/// first.
struct DataContrast {
  std::string one, other;
  std::string at;               ///< The level, such as "0.5".
  DataValue difference, ratio;  ///< There is no ratio unless both thresholds are above 0.
  std::string p_value, p_value_holm;
  bool differs = false;  ///< Whether they differ by the adjusted p value.
};

/// One way in which groups may share parameters.
struct DataModel {
  std::string name;
  int num_parameters = 0;
  std::string log_likelihood, aic, bic;
  bool has_least_aic = false, has_least_bic = false;
};

struct DataComparison {
  /// Why there is no comparison, or what it leaves out; "" for neither.
  std::string reason;
  std::vector<DataVerdict> verdicts;
  std::vector<DataContrast> contrasts;
  std::vector<DataModel> models;
};

/// `curves` holds its fits, or the chance that is suspected.
[[nodiscard]] DataResults data_results(const CurveAnalysis& curves);
[[nodiscard]] DataComparison data_comparison(const analysis::CurveComparison& comparison);

}  // namespace jnd::app
