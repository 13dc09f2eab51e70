#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/data/answer_cells.h"

namespace jnd::analysis {

/// Receives a table row by row while it is read.
class RowSink {
 public:
  explicit RowSink(std::string name) : problems_(std::move(name)) {}
  virtual ~RowSink() = default;
  RowSink(const RowSink&) = delete;
  RowSink& operator=(const RowSink&) = delete;

  virtual void set_header(std::vector<std::string> header, int line) = 0;
  /// `decimal_comma` says whether commas do not separate cells, so that numbers may contain
  /// them.
  virtual void add_row(const std::vector<std::string_view>& cells, int line,
                       bool decimal_comma) = 0;

  [[nodiscard]] TableProblems& problems() noexcept { return problems_; }

 private:
  TableProblems problems_;
};

/// Reads a table from any program in chunks, so that it is never in memory as a whole.
///
/// Text: A header line is followed by rows. They are separated by commas, semicolons or tabs,
/// whichever is most frequent in the header. Quotes follow RFC 4180. Decimals have a point, or
/// a comma if commas do not separate. Rows may be shorter than the header, or longer by empty
/// cells, as PsychoPy writes them. Its lines from `extraInfo` on are not rows. JSON: A list of
/// objects, as jsPsych writes it; `a.b` names a value within an object, and the place in the
/// list serves as the line. Throws `core::Error` if the file is not a table. Not real time.
void read_rows(const std::filesystem::path& file, RowSink& sink);

/// Reads a text in the same way. The sink has its name.
void parse_rows(std::string_view text, RowSink& sink);

}  // namespace jnd::analysis
