#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace jnd::analysis {

/// Says what is wrong with a formula, and where.
class FormulaError : public core::Error {
 public:
  FormulaError(const std::string& sentence, const std::string& formula, std::size_t at);
  /// Two indented lines: the formula, and a caret below the place of the error.
  std::string picture;
};

/// A column, or functions of one, as it stands in a formula: `u`, `log(u)`, `scale(log(u))`.
struct FormulaVariable {
  std::string name;  ///< The name that R gives to the result.
  std::string column;
  std::vector<std::string> functions;  ///< The innermost function comes first.
  std::size_t at = 0;                  ///< The offset at which it begins in the text.
};

/// The functions that a formula may apply to a column.
inline constexpr const char* kFormulaFunctions =
    "log, log2, log10, exp, sqrt, abs, scale, center, factor";

/// The right side of a formula as in R (Wilkinson and Rogers 1973), split into its parts.
struct Formula {
  std::string text;
  bool has_intercept = true;
  /// At most 60, in the order in which they first appear.
  std::vector<FormulaVariable> variables;
  /// Products of variables as ascending indices into `variables`. Terms of fewer variables come
  /// first, as in R.
  std::vector<std::vector<std::size_t>> terms;
};

/// A term `(effects | group)`: effects that differ between groups.
struct RandomTerm {
  Formula effects;
  bool is_correlated = true;  ///< False for `||`.
  /// Columns whose cells together identify a group. `a:b` has several.
  std::vector<std::string> group_columns;
  std::string group;         ///< The name that R gives to the group: "item", "b:a".
  std::size_t group_at = 0;  ///< The offset at which the group begins in the text.
};

/// Reads a formula such as `u * condition`. It understands + and - between terms, : for
/// products, a * b for a + b + a:b, a / b for a + a:b, (a + b)^2, parentheses, 0 or -1 for no
/// intercept, functions of a column, and names in backquotes. Throws `FormulaError`.
/// Not real time.
[[nodiscard]] Formula parse_formula(const std::string& text);

/// Reads `1 + u | participant`, or several such terms in parentheses with + between them. `a /
/// b` after the bar stands for `a` and `b:a`. Throws `FormulaError`. Not real time.
[[nodiscard]] std::vector<RandomTerm> parse_random_terms(const std::string& text);

}  // namespace jnd::analysis
