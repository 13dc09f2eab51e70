#pragma once

#include <string>
#include <vector>

#include "core/storage/database.h"

namespace jnd::core {

/// What a withdrawal and a backup do with the rows of a table.
struct TableRule {
  std::string table;
  /// The column by which a withdrawal finds the rows of a person and deletes them: `session`,
  /// `participant`, or "" if the rows stay.
  std::string erased_by;
  /// A backup is replaced only if the study has every row of it, apart from erased ones.
  bool is_compared = true;
  std::string row;  ///< What one row is, in a sentence.
};

/// The rules of all tables that the database has, as its layout says. A table with a column
/// `session`, or else `participant`, holds something of a person, and every table is compared;
/// `table_rules.cpp` lists what is otherwise. Throws `Error` as `Statement` does. Not real
/// time.
[[nodiscard]] std::vector<TableRule> table_rules(Database& database);

}  // namespace jnd::core
