#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/data/answer_cells.h"

namespace jnd::analysis {

/// Takes a table row by row, while it is read.
class RowSink {
 public:
  explicit RowSink(std::string name) : problems_(std::move(name)) {}
  virtual ~RowSink() = default;
  RowSink(const RowSink&) = delete;
  RowSink& operator=(const RowSink&) = delete;

  virtual void set_header(std::vector<std::string> header, int line) = 0;
  /// `decimal_comma`: whether commas do not separate cells, so that numbers may have them.
  virtual void add_row(const std::vector<std::string_view>& cells, int line,
                       bool decimal_comma) = 0;

  [[nodiscard]] TableProblems& problems() noexcept { return problems_; }

 private:
  TableProblems problems_;
};

/// Reads a table of anybody's program chunk by chunk, so that it is never held as a whole.
///
/// Text: a header line, then rows, separated by commas, semicolons or tabs, whichever the
/// header has most of; quotes as RFC 4180 has them. Decimals have a point, or a comma where
/// that does not separate. Rows may be shorter than the header, and longer by empty cells, as
/// PsychoPy writes them; its lines from `extraInfo` on are no rows. JSON: a list of objects, as
/// jsPsych writes it; `a.b` names what is within an object, and the place in the list stands
/// for the line. Throws `core::Error` for what is no table. Not real time.
void read_rows(const std::filesystem::path& file, RowSink& sink);

/// The same of a text, which the sink has the name of.
void parse_rows(std::string_view text, RowSink& sink);

}  // namespace jnd::analysis
