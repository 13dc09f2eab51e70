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
  kTreatment,  ///< Each level but the first against the first.
  kSum,        ///< Each level but the last against the mean of all; the last has -1 throughout.
};

/// A variable of a formula over the rows of a table: numbers, or the levels of a factor, in
/// numeric order where all are numbers and else in that of their bytes.
struct CodedVariable {
  std::string name, column;
  std::vector<std::string> functions;
  bool is_factor = false;
  std::vector<std::string> levels;  ///< Of a factor.
  /// Of each different cell of the column: the number, or the place of the level.
  std::vector<double> value_of_cell;
  /// What each `scale` or `center` takes off and divides by, the innermost first: mean over the
  /// rows, and the standard deviation with n - 1.
  std::vector<std::pair<double, double>> standards;

  /// The number that the functions make of this one.
  [[nodiscard]] double transformed(double number) const;
};

/// The columns that a formula makes of a table, as R's `model.matrix` does (Chambers and
/// Hastie 1992): in a term a factor has contrasts where the term without it is in the formula
/// too, else a column for each level.
class Design {
 public:
  /// Throws `FormulaError` for numbers that a function has none for, text where numbers are
  /// needed and a factor of one level; `core::Error` if there are no rows.
  Design(const Formula& formula, const TrialTable& table, Contrasts contrasts);

  /// `(Intercept)` first, then as R names them: `u`, `conditionB`, `u:conditionB`.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  [[nodiscard]] const std::vector<CodedVariable>& variables() const noexcept {
    return variables_;
  }
  /// A row for each of the table, a column for each name.
  [[nodiscard]] Eigen::MatrixXd matrix(const TrialTable& table) const;

  /// The row that these values have: of each variable its number, with functions applied, or
  /// the place of its level.
  [[nodiscard]] Eigen::VectorXd row(const std::vector<double>& values) const;

 private:
  /// What a variable contributes to a column: itself, or an entry of its contrasts by level.
  struct Factor {
    std::size_t variable = 0;
    std::vector<double> by_level;  ///< Empty for a number.
  };

  std::vector<CodedVariable> variables_;
  std::vector<std::vector<Factor>> columns_;
  std::vector<std::string> names_;
};

}  // namespace jnd::analysis
