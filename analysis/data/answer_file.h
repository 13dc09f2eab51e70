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

/// Which cells of a table of answers say what. Names of columns as the file has them.
struct AnswerColumns {
  std::string intensity;
  /// A yes or a no, or with `trials` how many were yes.
  std::string yes;
  std::optional<std::string> yes_value;  ///< The cell that is a yes; every other one is a no.
  std::optional<std::string> trials;     ///< Each row is one trial where absent.
  std::vector<std::string> group_by;
  /// Column and cell; rows that have another one are left out.
  std::vector<std::pair<std::string, std::string>> where;
  bool signed_intensities = true;  ///< Whether an intensity may be < 0.
};

/// Answers at one intensity of one group.
struct AnswerTally {
  double intensity = 0.0;
  std::int64_t num_yes = 0, num_trials = 0;
};

/// The rows of one group, each intensity once, in the order of their first rows.
struct AnswerGroup {
  std::vector<std::pair<std::string, std::string>> key;  ///< Column and cell; empty for all.
  std::vector<AnswerTally> tallies;
};

/// What a file of answers has.
struct AnswerFile {
  std::vector<AnswerGroup> groups;  ///< In the order of their first rows; one without grouping.
  std::vector<std::string> columns;
  std::int64_t num_rows = 0;       ///< Below the header.
  std::int64_t num_elsewhere = 0;  ///< Left out by `where`.
  /// Left out because a cell that is needed is empty, NA, null, NaN or None, or, of a column
  /// that groups, empty or NA: by column.
  std::map<std::string, std::int64_t> num_missing;
  /// Where `yes_value` says what is a yes: trials of each other cell, of which all are a no; at
  /// most 20 of them.
  std::map<std::string, std::int64_t> num_no;
  /// Different cells of columns that tell people or conditions apart but are not grouped by;
  /// at most 1000 of each are counted.
  std::map<std::string, std::size_t> num_pooled;
};

/// Whether a column of this name tells people or conditions apart, as other programs call them.
[[nodiscard]] bool tells_rows_apart(std::string_view column) noexcept;

/// Reads answers row by row, adding up those of one group and intensity, so that a file of a
/// million rows takes no more memory than it has different intensities.
///
/// Text: a header line, then rows, separated by commas, semicolons or tabs, whichever the
/// header has most of; quotes as RFC 4180 has them. Decimals have a point, or a comma where
/// that does not separate. Rows may be shorter than the header, and longer by empty cells, as
/// PsychoPy writes them; its lines from `extraInfo` on are no rows. JSON: a list of objects, as
/// jsPsych writes it; `a.b` names what is within an object. A trial of jsPsych that has no
/// `response` was not answered in time; it is left out and counted as missing.
///
/// A yes is 1, true or yes, a no is 0, -1, false or no, in any case of letters. Throws
/// `core::Error` with every problem (at most 20), each "FILE:LINE: column: expected this, found
/// that", of JSON with the place in the list for the line. Not real time.
[[nodiscard]] AnswerFile read_answer_file(const std::filesystem::path& file,
                                          const AnswerColumns& columns);

/// The same of a text; `name` is what messages call it.
[[nodiscard]] AnswerFile parse_answers(std::string_view text, const std::string& name,
                                       const AnswerColumns& columns);

}  // namespace jnd::analysis
