#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/data/answer_cells.h"
#include "core/error.h"

namespace jnd::analysis {

/// Which columns of a table of trials or counts are needed.
struct TrialColumns {
  AnswerWords answers;
  std::vector<std::string> variables;  ///< Each once.
  /// Column and cell; rows that have another one are left out.
  std::vector<std::pair<std::string, std::string>> where;
};

/// A column besides the answers. Different cells are kept once, so that a million rows take
/// four bytes each.
struct TrialVariable {
  std::string name;
  std::vector<std::string> cells;    ///< Different ones, in the order of their first rows.
  std::vector<double> numbers;       ///< Of each of `cells`; NaN for what is none.
  std::vector<std::uint32_t> place;  ///< Of each row, in `cells`.

  /// Whether every cell is a number.
  [[nodiscard]] bool is_numeric() const noexcept;
  [[nodiscard]] double number(std::size_t row) const { return numbers[place[row]]; }
  [[nodiscard]] const std::string& cell(std::size_t row) const { return cells[place[row]]; }
};

/// Rows of trials or counts in the order of the file.
struct TrialTable {
  std::vector<TrialVariable> variables;  ///< In the order in which they were asked for.
  std::vector<double> num_yes, num_trials;
  std::int64_t num_rows_in_file = 0;  ///< Below the header.
  std::int64_t num_elsewhere = 0;     ///< Left out by `where`.
  std::int64_t num_without_trials = 0;
  std::map<std::string, std::int64_t> num_missing;  ///< Rows left out, by the empty column.

  [[nodiscard]] std::size_t num_rows() const noexcept { return num_yes.size(); }
  /// None where no variable has this name.
  [[nodiscard]] const TrialVariable* find(std::string_view name) const noexcept;
};

/// Rows of a table that agree in some columns.
struct TrialGroup {
  std::vector<std::pair<std::string, std::string>> key;  ///< Column and cell.
  /// Without those columns, and with no cells but the group's. What was left out of the file is
  /// told by the whole table alone.
  TrialTable table;
};

/// Groups in the order of their first rows; without columns one, of all rows. `columns` are
/// variables of the table.
[[nodiscard]] std::vector<TrialGroup> groups_of(const TrialTable& table,
                                                const std::vector<std::string>& columns);

/// The table has no column of this name.
class UnknownColumn : public core::Error {
 public:
  UnknownColumn(const std::string& where, std::string missing,
                const std::vector<std::string>& header);
  std::string column;
  std::string known;  ///< "a, b, c"
};

/// Reads the file as `read_rows`, and answers as `counted_answers`. Throws `UnknownColumn` for
/// a variable that is no column, `core::Error` for every other problem. Not real time.
[[nodiscard]] TrialTable read_trial_table(const std::filesystem::path& file,
                                          const TrialColumns& columns);

/// The same of a text; `name` is what messages call it.
[[nodiscard]] TrialTable parse_trial_table(std::string_view text, const std::string& name,
                                           const TrialColumns& columns);

}  // namespace jnd::analysis
