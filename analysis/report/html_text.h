#pragma once

#include <string>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// A text as it may stand in HTML, attributes included.
[[nodiscard]] std::string html_escaped(const std::string& text);

/// A table of a report. Cells are plain text.
struct HtmlTable {
  struct Column {
    std::string title;
    bool is_number = false;  ///< Set to the right, in figures of one width.
    bool is_name = false;    ///< A name of the program: set as code; words on a second line.
    /// Words, then a second line with a name of the program, which may be empty, then more
    /// words on a third.
    bool is_titled = false;
  };
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  ///< Below the table.
};

/// The body of a report, from top to bottom. All text is plain and escaped here.
class HtmlText {
 public:
  HtmlText() = default;
  /// `mark`: "S" before every number, of a supplement.
  explicit HtmlText(std::string mark) : mark_(std::move(mark)) {}

  /// Levels 2 to 4; level 2 and 3 are counted: "3.1 Group D".
  void heading(int level, const std::string& text);
  void paragraph(const std::string& text, const std::string& style = "");
  /// A paragraph that begins with words set apart: "Participants. ..."
  void paragraph_about(const std::string& topic, const std::string& text);
  void list(const std::vector<std::string>& items);
  /// Numbered like figures are. Nothing for a table without rows.
  void table(const HtmlTable& table);
  /// `svg` as gnuplot wrote it; its identifiers are made the figure's own. "" leaves the
  /// caption alone. Returns its number.
  int figure(const std::string& name, const std::string& svg, const std::string& title,
             const std::string& caption);

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// Level 2 headings with their identifiers, for a table of contents.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& sections()
      const noexcept {
    return sections_;
  }

 private:
  std::string mark_, text_;
  std::vector<std::pair<std::string, std::string>> sections_;
  int section_ = 0, subsection_ = 0, num_tables_ = 0, num_figures_ = 0;
};

/// The whole document around a body. `mark` stands at the top of every printed page: "SIMULATED
/// data"; "" for nothing. `style`: CSS of this kind of document besides.
[[nodiscard]] std::string html_document(const std::string& title, const std::string& mark,
                                        const std::string& body, const std::string& style = "");

}  // namespace jnd::analysis
