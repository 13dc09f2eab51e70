#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/data/trial_table.h"
#include "analysis/mixed/formula.h"

namespace jnd::analysis {

/// How the levels of a factor become columns.
enum class Contrasts {
  kTreatment,  ///< Each level except the first is compared with the first.
  /// Each level except the last is compared with the mean of all. The last has -1 in every
  /// column.
  kSum,
};

/// A variable of a formula over the rows of a table: numbers, or the levels of a factor. Levels
/// are in numeric order if all are numbers, and otherwise in the order of their bytes.
struct CodedVariable {
  std::string name, column;
  std::vector<std::string> functions;
  bool is_factor = false;
  std::vector<std::string> levels;  ///< The levels of a factor.
  /// For each different cell of the column, the number or the index of the level.
  std::vector<double> value_of_cell;
  /// For each `scale` or `center`, the innermost first, what it subtracts and divides by: the
  /// mean over the rows, and the standard deviation with n - 1.
  std::vector<std::pair<double, double>> standards;

  /// The result of the functions for this number.
  [[nodiscard]] double transformed(double number) const;
};

/// The columns that a formula makes of a table, as R's `model.matrix` does (Chambers and Hastie
/// 1992). A factor in a term has contrasts if the formula also has the term without this
/// factor. Otherwise it has a column for each level.
class Design {
 public:
  /// Throws `FormulaError` if a function is undefined for a number, if a cell is text where
  /// numbers are needed, or if a factor has only one level. Throws `core::Error` if there are
  /// no rows.
  Design(const Formula& formula, const TrialTable& table, Contrasts contrasts);

  /// `(Intercept)` comes first. The other names are as in R: `u`, `conditionB`, `u:conditionB`.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  [[nodiscard]] const std::vector<CodedVariable>& variables() const noexcept {
    return variables_;
  }
  /// One row for each row of the table, and one column for each name.
  [[nodiscard]] Eigen::MatrixXd matrix(const TrialTable& table) const;

  /// The design's row for these values: for each variable its number after the functions, or
  /// the index of its level.
  [[nodiscard]] Eigen::VectorXd row(const std::vector<double>& values) const;

 private:
  /// What a variable contributes to a column: itself, or the entries of a contrast by level.
  struct Factor {
    std::size_t variable = 0;
    std::vector<double> by_level;  ///< Empty for a number.
  };

  std::vector<CodedVariable> variables_;
  std::vector<std::vector<Factor>> columns_;
  std::vector<std::string> names_;
};

}  // namespace jnd::analysis
