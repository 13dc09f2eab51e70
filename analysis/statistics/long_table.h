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

/// The roles of the columns of a table in long format, which has one value in each row.
struct LongColumns {
  std::string value;  ///< The column of the number that is compared.
  std::string by;     ///< The column of the condition to which the value belongs.
  /// The column of the person to whom the value belongs; "" if the conditions are groups of
  /// different people.
  std::string pair;
  std::vector<std::string> group_by;
  /// The conditions that are compared, in this order. If it is empty, all conditions are, in
  /// the order of their first rows.
  std::vector<std::string> levels;
};

/// The rows that agree in the grouping columns.
struct LongGroup {
  /// Columns and their values. It is empty if there are no grouping columns.
  std::vector<std::pair<std::string, std::string>> key;
  std::vector<std::string> conditions;
  /// The values of each condition, in the order of the rows.
  std::vector<std::vector<double>> values;
  /// With `pair`: the people who have a value under every condition. Several values are
  /// averaged.
  RepeatedMeasures complete;
  std::vector<std::string> incomplete;  ///< The people who do not, and are left out.
  /// The number of cells (a person and a condition) with several values.
  int num_averaged = 0;
};

struct LongTable {
  std::vector<LongGroup> groups;  ///< In the order of their first rows.
  /// The number of rows left out because a cell is empty, NA, null, NaN or None.
  std::int64_t num_missing = 0;
};

/// Reads the file as `read_rows` does: commas, semicolons or tabs, decimal commas, JSON. Throws
/// `core::Error` with the problems in the form "FILE:LINE: column: expected this, found that".
[[nodiscard]] LongTable read_long(const std::filesystem::path& file,
                                  const LongColumns& columns);

/// Reads a text in the same way. `name` is its name in messages.
[[nodiscard]] LongTable parse_long(std::string_view text, const std::string& name,
                                   const LongColumns& columns);

/// Two conditions as the columns a and b. With `are_paired` they hold only people who have a
/// value under both. Throws `core::Error` that begins with `name` if there are not two
/// conditions.
[[nodiscard]] ComparedColumns two_conditions(const LongGroup& group, bool are_paired,
                                             const std::string& name);

}  // namespace jnd::analysis
