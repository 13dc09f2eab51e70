#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/charts/figure_table.h"
#include "app/curves/curve_analysis.h"

namespace jnd::app {

// The curves of somebody's table in words and numbers as they are shown; the same ones that
// `jnd fit psychometric` prints.

struct DataValue {
  std::string value;     ///< "12.3"; "-" for none.
  std::string interval;  ///< "10.1 to 14.2"; "" for none.
};

/// One of the numbers of a curve.
struct DataNumber {
  std::string name;  ///< "PSE", "threshold 0.75"
  DataValue number;
  std::string remark;  ///< "where the curve is half way up"
};

/// A group of answers and its curve.
struct DataGroup {
  std::string name;  ///< "condition light"; "all rows".
  std::int64_t num_trials = 0;
  std::string reason;  ///< Why it has no curve; "" where it has one.
  DataValue location, scale, pse, jnd;
  std::vector<DataValue> thresholds;  ///< As `DataResults::levels`.
  std::string deviance;
  std::vector<DataNumber> numbers;  ///< Every one.
  std::vector<std::string> cautions;
};

/// What the fits come to.
struct DataResults {
  std::string formula;         ///< "rising curve 1 / (1 + exp(...))"
  std::string title;           ///< "Fits, with 95 % by the likelihood ratio"
  std::vector<double> levels;  ///< Of the thresholds.
  std::vector<DataGroup> groups;
  std::vector<analysis::FigureTable> tables;  ///< As `picture_tables`; of `groups` by number.
  bool is_logarithmic = false;
  std::optional<double> chance;    ///< The guess rate where it is known and above 0.
  std::string x_title, y_title;    ///< "delay_ms", "percent of num_first"
  std::vector<std::string> notes;  ///< What was left out and added up, a sentence each.
  /// The answers look like right ones of a forced choice among so many, and nobody said what
  /// the task was: nothing is fitted until somebody does.
  std::optional<int> suspected_alternatives;
};

/// "The location differs: ..." and whether it is found to.
struct DataVerdict {
  std::string sentence;
  bool differs = false;
};

/// Two groups' thresholds, the second less the first and over it.
struct DataContrast {
  std::string one, other;
  std::string at;               ///< "0.5"
  DataValue difference, ratio;  ///< Of thresholds that are not above 0 there is no ratio.
  std::string p_value, p_value_holm;
  bool differs = false;  ///< By the adjusted p value.
};

/// One way in which groups may share parameters.
struct DataModel {
  std::string name;
  int num_parameters = 0;
  std::string log_likelihood, aic, bic;
  bool has_least_aic = false, has_least_bic = false;
};

struct DataComparison {
  std::string reason;  ///< Why there is none, or what is left out of it; "" for nothing.
  std::vector<DataVerdict> verdicts;
  std::vector<DataContrast> contrasts;
  std::vector<DataModel> models;
};

/// `curves` has its fits, or a chance that is suspected.
[[nodiscard]] DataResults data_results(const CurveAnalysis& curves);
[[nodiscard]] DataComparison data_comparison(const analysis::CurveComparison& comparison);

}  // namespace jnd::app
