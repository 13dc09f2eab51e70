#include "analysis/mixed/design.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace jnd::analysis {
namespace {

double applied(const std::string& function, double number) {
  if (function == "log") return std::log(number);
  if (function == "log2") return std::log2(number);
  if (function == "log10") return std::log10(number);
  if (function == "exp") return std::exp(number);
  if (function == "sqrt") return std::sqrt(number);
  return std::fabs(number);
}

bool is_standard(const std::string& function) {
  return function == "scale" || function == "center";
}

/// The mean over the rows, and for `scale` the standard deviation.
std::pair<double, double> standard_of(const std::string& function,
                                      const std::vector<double>& values,
                                      const std::vector<std::uint32_t>& place) {
  double sum = 0.0, squares = 0.0;
  for (const std::uint32_t at : place) sum += values[at];
  const double mean = sum / static_cast<double>(place.size());
  if (function == "center") return {mean, 1.0};
  for (const std::uint32_t at : place) squares += (values[at] - mean) * (values[at] - mean);
  return {mean, std::sqrt(squares / static_cast<double>(place.size() - 1))};
}

/// Puts the levels into order, and stores the index of each cell's level.
void code_levels(CodedVariable& coded, const TrialVariable& column) {
  coded.is_factor = true;
  std::vector<std::size_t> order(column.cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const bool by_number = column.is_numeric();
  std::ranges::sort(order, [&](std::size_t one, std::size_t other) {
    return by_number ? column.numbers[one] < column.numbers[other]
                     : column.cells[one] < column.cells[other];
  });
  coded.value_of_cell.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || !by_number ||
                        // 1 and 1.0 are the same level.
                        column.numbers[order[i]] != column.numbers[order[i - 1]];
    if (is_new) coded.levels.push_back(column.cells[order[i]]);
    coded.value_of_cell[order[i]] = static_cast<double>(coded.levels.size() - 1);
  }
}

CodedVariable coded_variable(const FormulaVariable& variable, const TrialTable& table,
                             const std::string& text) {
  const TrialVariable& column = *table.find(variable.column);
  CodedVariable coded{.name = variable.name,
                      .column = variable.column,
                      .functions = variable.functions,
                      .is_factor = false,
                      .levels = {},
                      .value_of_cell = column.numbers,
                      .standards = {}};
  const bool is_asked = !variable.functions.empty() && variable.functions.front() == "factor";
  if (is_asked || (!column.is_numeric() && variable.functions.empty())) {
    if (variable.functions.size() > 1) {
      throw FormulaError(
          "expected numbers within " + variable.functions[1] + ", found a factor", text,
          variable.at);
    }
    code_levels(coded, column);
    if (coded.levels.size() < 2) {
      throw FormulaError("expected a factor of two levels or more, found " + coded.levels[0] +
                             " alone in the column " + variable.column,
                         text, variable.at);
    }
    return coded;
  }
  const auto fail = [&](std::size_t cell, const std::string& expected) {
    throw FormulaError("expected " + expected + " in the column " + variable.column +
                           ", found " + shown_cell(column.cells[cell]),
                       text, variable.at);
  };
  for (std::size_t i = 0; i < column.cells.size(); ++i) {
    if (std::isnan(column.numbers[i])) fail(i, "numbers alone");
  }
  for (const std::string& function : variable.functions) {
    if (function == "factor") {
      throw FormulaError("expected factor() of a column alone, found " + variable.name, text,
                         variable.at);
    }
    if (is_standard(function)) {
      coded.standards.push_back(standard_of(function, coded.value_of_cell, column.place));
      const auto [mean, spread] = coded.standards.back();
      if (!(spread > 0.0)) fail(0, "different numbers for scale()");
      for (double& value : coded.value_of_cell) value = (value - mean) / spread;
      continue;
    }
    for (std::size_t i = 0; i < coded.value_of_cell.size(); ++i) {
      coded.value_of_cell[i] = applied(function, coded.value_of_cell[i]);
      if (!std::isfinite(coded.value_of_cell[i])) {
        fail(i, "numbers that have a finite " + function + "()");
      }
    }
  }
  return coded;
}

/// One column of contrasts by level, and what it adds to the variable's name.
struct LevelColumn {
  std::string suffix;
  std::vector<double> by_level;
};

std::vector<LevelColumn> level_columns(const CodedVariable& variable, bool has_contrasts,
                                       Contrasts contrasts) {
  const std::size_t num_levels = variable.levels.size();
  std::vector<LevelColumn> columns;
  const bool is_treatment = has_contrasts && contrasts == Contrasts::kTreatment;
  const bool is_sum = has_contrasts && contrasts == Contrasts::kSum;
  for (std::size_t level = is_treatment ? 1 : 0; level < num_levels - (is_sum ? 1 : 0);
       ++level) {
    std::vector<double> entries(num_levels, 0.0);
    entries[level] = 1.0;
    if (is_sum) entries.back() = -1.0;
    columns.push_back(
        {is_sum ? std::to_string(level + 1) : variable.levels[level], std::move(entries)});
  }
  return columns;
}

}  // namespace

double CodedVariable::transformed(double number) const {
  std::size_t standard = 0;
  for (const std::string& function : functions) {
    if (is_standard(function)) {
      const auto [mean, spread] = standards[standard++];
      number = (number - mean) / spread;
    } else {
      number = applied(function, number);
    }
  }
  return number;
}

Design::Design(const Formula& formula, const TrialTable& table, Contrasts contrasts) {
  if (table.num_rows() == 0) throw core::Error("expected rows with answers, found none");
  for (const FormulaVariable& variable : formula.variables) {
    variables_.push_back(coded_variable(variable, table, formula.text));
  }
  if (formula.has_intercept) {
    names_.emplace_back("(Intercept)");
    columns_.emplace_back();
  }
  for (const std::vector<std::size_t>& term : formula.terms) {
    // The first variable of a term varies fastest.
    std::vector<std::string> names = {""};
    std::vector<std::vector<Factor>> columns = {{}};
    for (const std::size_t place : term) {
      const CodedVariable& variable = variables_[place];
      std::vector<LevelColumn> of_variable = {{"", {}}};
      if (variable.is_factor) {
        std::vector<std::size_t> without = term;
        std::erase(without, place);
        const bool is_there =
            without.empty() ? formula.has_intercept
                            : std::ranges::find(formula.terms, without) != formula.terms.end();
        of_variable = level_columns(variable, is_there, contrasts);
      }
      std::vector<std::string> longer_names;
      std::vector<std::vector<Factor>> longer;
      for (const LevelColumn& one : of_variable) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
          longer_names.push_back(names[i] + (names[i].empty() ? "" : ":") + variable.name +
                                 one.suffix);
          longer.push_back(columns[i]);
          longer.back().push_back({place, one.by_level});
        }
      }
      names = std::move(longer_names);
      columns = std::move(longer);
    }
    names_.insert(names_.end(), names.begin(), names.end());
    columns_.insert(columns_.end(), columns.begin(), columns.end());
  }
}

Eigen::VectorXd Design::row(const std::vector<double>& values) const {
  Eigen::VectorXd row = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(columns_.size()));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    for (const Factor& factor : columns_[i]) {
      const double value = values[factor.variable];
      row[static_cast<Eigen::Index>(i)] *=
          factor.by_level.empty() ? value : factor.by_level[static_cast<std::size_t>(value)];
    }
  }
  return row;
}

Eigen::MatrixXd Design::matrix(const TrialTable& table) const {
  std::vector<const TrialVariable*> columns;
  for (const CodedVariable& variable : variables_) {
    columns.push_back(table.find(variable.column));
  }
  Eigen::MatrixXd all(static_cast<Eigen::Index>(table.num_rows()),
                      static_cast<Eigen::Index>(columns_.size()));
  std::vector<double> values(variables_.size());
  for (std::size_t i = 0; i < table.num_rows(); ++i) {
    for (std::size_t v = 0; v < values.size(); ++v) {
      values[v] = variables_[v].value_of_cell[columns[v]->place[i]];
    }
    all.row(static_cast<Eigen::Index>(i)) = row(values).transpose();
  }
  return all;
}

}  // namespace jnd::analysis
