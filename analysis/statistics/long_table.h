#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/statistics/comparison_data.h"
#include "analysis/statistics/omnibus_test.h"

namespace jnd::analysis {

/// Which columns of a table in long format, one value a row, say what.
struct LongColumns {
  std::string value;  ///< The number that is compared.
  std::string by;     ///< The condition that it belongs to.
  std::string pair;   ///< Whose it is; "" where the conditions are groups of different people.
  std::vector<std::string> group_by;
  /// The conditions that are compared, in this order; all, in that of their first rows, if
  /// empty.
  std::vector<std::string> levels;
};

/// The rows that agree in the grouping columns.
struct LongGroup {
  std::vector<std::pair<std::string, std::string>> key;  ///< Column and value; empty for all.
  std::vector<std::string> conditions;
  std::vector<std::vector<double>> values;  ///< Of each condition, in the order of the rows.
  /// With `pair`: who has a value under every condition; several are averaged.
  RepeatedMeasures complete;
  std::vector<std::string> incomplete;  ///< Who has not, and is left out.
  int num_averaged = 0;  ///< Cells of a person and condition with several values.
};

struct LongTable {
  std::vector<LongGroup> groups;  ///< In the order of their first rows.
  std::int64_t num_missing = 0;   ///< Rows left out: a cell is empty, NA, null, NaN or None.
};

/// Reads the file as `read_rows`: commas, semicolons or tabs, decimal commas, JSON. Throws
/// `core::Error` with the problems, each "FILE:LINE: column: expected this, found that".
[[nodiscard]] LongTable read_long(const std::filesystem::path& file,
                                  const LongColumns& columns);

/// The same of a text; `name` is what messages call it.
[[nodiscard]] LongTable parse_long(std::string_view text, const std::string& name,
                                   const LongColumns& columns);

/// Two conditions as the columns a and b; with `are_paired`, of the people who have a value
/// under both. Throws `core::Error` that begins with `name` where there are not two.
[[nodiscard]] ComparedColumns two_conditions(const LongGroup& group, bool are_paired,
                                             const std::string& name);

}  // namespace jnd::analysis
