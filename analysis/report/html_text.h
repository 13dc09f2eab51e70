#pragma once

#include <string>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// A text that is safe in HTML, including attributes.
[[nodiscard]] std::string html_escaped(const std::string& text);

/// A table of a report. Cells are plain text.
struct HtmlTable {
  struct Column {
    std::string title;
    /// Whether cells are aligned to the right, with digits of one width.
    bool is_number = false;
    /// Whether cells are names of the program. They are set as code; a second line holds words.
    bool is_name = false;
    /// Whether cells have words, then a second line with a name of the program, which may be
    /// empty, and then a third line with more words.
    bool is_titled = false;
  };
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  ///< Notes below the table.
};

/// The body of a report, from top to bottom. All text is plain and is escaped here.
class HtmlText {
 public:
  HtmlText() = default;
  /// `mark` stands before every number, such as "S" in a supplement.
  explicit HtmlText(std::string mark) : mark_(std::move(mark)) {}

  /// A heading of level 2 to 4. Levels 2 and 3 are numbered: "3.1 Group D".
  void heading(int level, const std::string& text);
  void paragraph(const std::string& text, const std::string& style = "");
  /// A paragraph that begins with a highlighted topic: "Participants. ...".
  void paragraph_about(const std::string& topic, const std::string& text);
  void list(const std::vector<std::string>& items);
  /// Tables are numbered as figures are. A table without rows is not written.
  void table(const HtmlTable& table);
  /// `svg` is the text that gnuplot wrote. Its identifiers are made unique to the figure. If it
  /// is "", only the caption is written. Returns the figure's number.
  int figure(const std::string& name, const std::string& svg, const std::string& title,
             const std::string& caption);

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// The level 2 headings with their identifiers, for a table of contents.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& sections()
      const noexcept {
    return sections_;
  }

 private:
  std::string mark_, text_;
  std::vector<std::pair<std::string, std::string>> sections_;
  int section_ = 0, subsection_ = 0, num_tables_ = 0, num_figures_ = 0;
};

/// The whole document around a body. `mark` stands at the top of every printed page, such as
/// "SIMULATED data"; "" for nothing. `style` is additional CSS for this kind of document.
[[nodiscard]] std::string html_document(const std::string& title, const std::string& mark,
                                        const std::string& body, const std::string& style = "");

}  // namespace jnd::analysis
