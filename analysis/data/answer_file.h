#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// The roles of the columns in a table of answers. Names are those in the file.
struct AnswerColumns {
  std::string intensity;
  /// The column with a yes or a no or, with `trials`, the number of yes.
  std::string yes;
  /// The cell that means yes. Every other cell means no.
  std::optional<std::string> yes_value;
  std::optional<std::string> trials;  ///< If absent, each row is one trial.
  std::vector<std::string> group_by;
  /// Columns and cells. Rows with another cell are left out.
  std::vector<std::pair<std::string, std::string>> where;
  bool signed_intensities = true;  ///< Whether an intensity may be < 0.
};

/// The answers at one intensity of one group.
struct AnswerTally {
  double intensity = 0.0;
  std::int64_t num_yes = 0, num_trials = 0;
};

/// The rows of one group. Each intensity occurs once, in the order of the first rows.
struct AnswerGroup {
  /// Columns and their cells. It is empty if there are no grouping columns.
  std::vector<std::pair<std::string, std::string>> key;
  std::vector<AnswerTally> tallies;
};

/// The content of a file of answers.
struct AnswerFile {
  /// In the order of their first rows. Without grouping there is one.
  std::vector<AnswerGroup> groups;
  std::vector<std::string> columns;
  std::int64_t num_rows = 0;       ///< The number of rows below the header.
  std::int64_t num_elsewhere = 0;  ///< The number of rows left out by `where`.
  /// For each column, the number of rows left out because a required cell is empty, NA, null,
  /// NaN or None. In a grouping column only empty and NA count as missing.
  std::map<std::string, std::int64_t> num_missing;
  /// If `yes_value` defines yes: the number of trials for each other cell, all of which mean
  /// no. At most 20 cells are counted.
  std::map<std::string, std::int64_t> num_no;
  /// The number of different cells in columns that distinguish people or conditions but are not
  /// used for grouping. At most 1000 of each are counted.
  std::map<std::string, std::size_t> num_pooled;
};

/// Whether a column of this name distinguishes people or conditions, by the names that other
/// programs use.
[[nodiscard]] bool tells_rows_apart(std::string_view column) noexcept;

/// Reads answers row by row and adds up those of one group and intensity. So a file of a
/// million rows needs no more memory than its different intensities.
///
/// Text: a header line, then rows, separated by commas, semicolons or tabs, whichever the
/// header has most of; quotes as RFC 4180 has them. Decimals have a point, or a comma where
/// that does not separate. Rows may be shorter than the header, and longer by empty cells, as
/// PsychoPy writes them; its lines from `extraInfo` on are no rows. JSON: a list of objects, as
/// jsPsych writes it; `a.b` names what is within an object. A trial of jsPsych that has no
/// `response` was not answered in time; it is left out and counted as missing, unless some of
/// these trials are a yes: then no response is an answer, as in tasks of go and no-go.
///
/// A yes is 1, true or yes, and a no is 0, -1, false or no, in any case. Throws `core::Error`
/// with every problem (at most 20) in the form "FILE:LINE: column: expected this, found that".
/// For JSON the line is the place in the list. Not real time.
[[nodiscard]] AnswerFile read_answer_file(const std::filesystem::path& file,
                                          const AnswerColumns& columns);

/// Reads a text in the same way. `name` is its name in messages.
[[nodiscard]] AnswerFile parse_answers(std::string_view text, const std::string& name,
                                       const AnswerColumns& columns);

}  // namespace jnd::analysis
