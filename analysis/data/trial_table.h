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
  std::vector<std::string> variables;  ///< The names of the variables, without repetition.
  /// Columns and cells. Rows with another cell are left out.
  std::vector<std::pair<std::string, std::string>> where;
};

/// A column besides the answers. Different cells are stored once, so a row takes four bytes.
struct TrialVariable {
  std::string name;
  std::vector<std::string> cells;    ///< The different cells, in the order of their first rows.
  std::vector<double> numbers;       ///< The number in each of `cells`; NaN if it is no number.
  std::vector<std::uint32_t> place;  ///< For each row, the index of its cell in `cells`.

  /// Whether every cell is a number.
  [[nodiscard]] bool is_numeric() const noexcept;
  [[nodiscard]] double number(std::size_t row) const { return numbers[place[row]]; }
  [[nodiscard]] const std::string& cell(std::size_t row) const { return cells[place[row]]; }
};

/// Rows of trials or counts, in the order of the file.
struct TrialTable {
  std::vector<TrialVariable> variables;  ///< In the order in which they were asked for.
  std::vector<double> num_yes, num_trials;
  std::int64_t num_rows_in_file = 0;  ///< The number of rows below the header.
  std::int64_t num_elsewhere = 0;     ///< The number of rows left out by `where`.
  std::int64_t num_without_trials = 0;
  /// The number of rows left out, by the column whose cell is empty.
  std::map<std::string, std::int64_t> num_missing;

  [[nodiscard]] std::size_t num_rows() const noexcept { return num_yes.size(); }
  /// nullptr if no variable has this name.
  [[nodiscard]] const TrialVariable* find(std::string_view name) const noexcept;
};

/// The rows of a table that agree in some columns.
struct TrialGroup {
  std::vector<std::pair<std::string, std::string>> key;  ///< Columns and their cells.
  /// The group's table without those columns, and only with the group's cells. Only the whole
  /// table says what was left out of the file.
  TrialTable table;
};

/// The groups in the order of their first rows. Without columns there is one, of all rows.
/// `columns` are variables of the table.
[[nodiscard]] std::vector<TrialGroup> groups_of(const TrialTable& table,
                                                const std::vector<std::string>& columns);

/// An error that says that the table has no column of this name.
class UnknownColumn : public core::Error {
 public:
  UnknownColumn(const std::string& where, std::string missing,
                const std::vector<std::string>& header);
  std::string column;
  std::string known;  ///< The known columns as "a, b, c".
};

/// Reads the file as `read_rows` does, and answers as `counted_answers` does. Throws
/// `UnknownColumn` if a variable is no column, and `core::Error` for every other problem.
/// Not real time.
[[nodiscard]] TrialTable read_trial_table(const std::filesystem::path& file,
                                          const TrialColumns& columns);

/// Reads a text in the same way. `name` is its name in messages.
[[nodiscard]] TrialTable parse_trial_table(std::string_view text, const std::string& name,
                                           const TrialColumns& columns);

}  // namespace jnd::analysis
