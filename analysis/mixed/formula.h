#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace jnd::analysis {

/// What is wrong with a formula, and where.
class FormulaError : public core::Error {
 public:
  FormulaError(const std::string& sentence, const std::string& formula, std::size_t at);
  /// The formula, and below it a caret; two indented lines.
  std::string picture;
};

/// A column, or functions of one, as they stand in a formula: `u`, `log(u)`, `scale(log(u))`.
struct FormulaVariable {
  std::string name;  ///< As R names what comes of it.
  std::string column;
  std::vector<std::string> functions;  ///< The innermost first.
  std::size_t at = 0;                  ///< Where it begins in the text.
};

/// What can be a function of a column in a formula.
inline constexpr const char* kFormulaFunctions =
    "log, log2, log10, exp, sqrt, abs, scale, center, factor";

/// The right side of a formula as R has them (Wilkinson and Rogers 1973), taken apart.
struct Formula {
  std::string text;
  bool has_intercept = true;
  std::vector<FormulaVariable> variables;  ///< In the order of their first places; at most 60.
  /// Products of variables, by their places in `variables`, ascending; those of fewer variables
  /// first, as in R.
  std::vector<std::vector<std::size_t>> terms;
};

/// `(effects | group)`: effects that differ between groups.
struct RandomTerm {
  Formula effects;
  bool is_correlated = true;  ///< False for `||`.
  /// Columns whose cells together tell groups apart: several for `a:b`.
  std::vector<std::string> group_columns;
  std::string group;         ///< As R names it: "item", "b:a".
  std::size_t group_at = 0;  ///< Where it begins in the text.
};

/// Reads `u * condition`: + and - of terms, : for products, a * b for a + b + a:b, a / b for
/// a + a:b, (a + b)^2, parentheses, 0 or -1 for no intercept, functions of a column, names in
/// backquotes. Throws `FormulaError`. Not real time.
[[nodiscard]] Formula parse_formula(const std::string& text);

/// Reads `1 + u | participant`, or several such in parentheses with + between them. `a / b`
/// after the bar stands for `a` and `b:a`. Throws `FormulaError`. Not real time.
[[nodiscard]] std::vector<RandomTerm> parse_random_terms(const std::string& text);

}  // namespace jnd::analysis
