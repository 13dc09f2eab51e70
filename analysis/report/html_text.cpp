#include "analysis/report/html_text.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// An SVG that can stand inside a document. It has no declaration, its identifiers are unique
/// in the document, and it has a name for readers who cannot see it.
std::string inline_svg(std::string svg, const std::string& name, const std::string& title) {
  const std::size_t start = svg.find("<svg");
  if (start == std::string::npos) return "";
  svg.erase(0, start);
  for (const char* mark :
       {" id='", " id=\"", "xlink:href='#", "xlink:href=\"#", "url(#", "url('#"}) {
    replace_all(svg, mark, std::string(mark) + name + "-");
  }
  replace_all(svg, "<title>Gnuplot</title>", "<title>" + html_escaped(title) + "</title>");
  const std::size_t described = svg.find("<desc>");
  const std::size_t end = svg.find("</desc>");
  if (described != std::string::npos && end != std::string::npos) {
    svg.erase(described, end + 7 - described);
  }
  svg.insert(4, " role=\"img\"");
  return svg;
}

/// A name that may be broken after its parts.
std::string breakable(const std::string& name) {
  std::string parts = html_escaped(name);
  replace_all(parts, "_", "_<wbr>");
  replace_all(parts, ".", ".<wbr>");
  return parts;
}

/// A name, with its meaning on a second line.
std::string name_cell(const std::string& text) {
  const std::size_t end = text.find('\n');
  std::string cell = "<code>" + breakable(text.substr(0, end)) + "</code>";
  if (end == std::string::npos) return cell;
  return cell + "<br><span class=\"meaning\">" + html_escaped(text.substr(end + 1)) + "</span>";
}

/// Words, a name, and more words.
std::string titled_cell(const std::string& text) {
  const std::size_t end = text.find('\n');
  std::string cell = html_escaped(text.substr(0, end));
  if (end == std::string::npos) return cell;
  const std::string rest = text.substr(end + 1);
  const std::size_t name_end = rest.find('\n');
  const std::string name = rest.substr(0, name_end);
  cell += "<br><span class=\"meaning\">";
  if (!name.empty()) cell += "<code>" + breakable(name) + "</code>";
  if (name_end != std::string::npos) {
    cell += (name.empty() ? "" : " ") + html_escaped(rest.substr(name_end + 1));
  }
  return cell + "</span>";
}

/// Whether a table is short enough for a third of a page, so that it is not broken. Words of
/// names take lines of their own.
bool is_short(const HtmlTable& table) {
  constexpr std::size_t kShortLines = 16;
  constexpr std::size_t kLettersALine = 45;
  std::size_t num_lines = 0;
  for (const std::vector<std::string>& row : table.rows) {
    std::size_t longest = 1;
    for (const std::string& cell : row) longest = std::max(longest, cell.size());
    num_lines += 1 + (longest - 1) / kLettersALine;
  }
  return num_lines <= kShortLines;
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        // Other control characters are invisible and not allowed, so they are removed.
        if (static_cast<unsigned char>(letter) >= 0x20 || letter == '\n' || letter == '\t') {
          escaped += letter;
        }
    }
  }
  return escaped;
}

void HtmlText::heading(int level, const std::string& text) {
  std::string number;
  std::string id;
  if (level == 2) {
    subsection_ = 0;
    number = mark_ + std::to_string(++section_) + " ";
    id = " id=\"section-" + std::to_string(section_) + "\"";
    sections_.emplace_back("section-" + std::to_string(section_), number + text);
  } else if (level == 3) {
    number = mark_ + std::to_string(section_) + "." + std::to_string(++subsection_) + " ";
  }
  const std::string tag = "h" + std::to_string(level);
  text_ += "<" + tag + id + ">" + number + html_escaped(text) + "</" + tag + ">\n";
}

void HtmlText::paragraph(const std::string& text, const std::string& style) {
  text_ += style.empty() ? "<p>" : "<p class=\"" + style + "\">";
  text_ += html_escaped(text) + "</p>\n";
}

void HtmlText::paragraph_about(const std::string& topic, const std::string& text) {
  const bool is_ended = topic.ends_with('?') || topic.ends_with('.');
  text_ += "<p><b>" + html_escaped(topic) + (is_ended ? "</b> " : ".</b> ") +
           html_escaped(text) + "</p>\n";
}

void HtmlText::list(const std::vector<std::string>& items) {
  if (items.empty()) return;
  text_ += "<ul>\n";
  for (const std::string& item : items) text_ += "<li>" + html_escaped(item) + "</li>\n";
  text_ += "</ul>\n";
}

void HtmlText::table(const HtmlTable& table) {
  if (table.rows.empty()) return;
  text_ += std::string("<div class=\"") + (is_short(table) ? "short table" : "table") +
           "\"><table>\n<caption><b>" +
           said("Table {}", mark_ + std::to_string(++num_tables_)) + ".</b> " +
           html_escaped(table.caption) + "</caption>\n<thead><tr>";
  for (const HtmlTable::Column& column : table.columns) {
    text_ += std::string(column.is_number ? "<th class=\"number\">" : "<th>") +
             breakable(column.title) + "</th>";
  }
  text_ += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    text_ += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const HtmlTable::Column column =
          i < table.columns.size() ? table.columns[i] : HtmlTable::Column{};
      text_ += column.is_number ? "<td class=\"number\">" : "<td>";
      text_ += column.is_name     ? name_cell(row[i])
               : column.is_titled ? titled_cell(row[i])
                                  : html_escaped(row[i]);
      text_ += "</td>";
    }
    text_ += "</tr>\n";
  }
  text_ += "</tbody></table>\n";
  for (const std::string& note : table.notes) {
    text_ += "<p class=\"note\">" + html_escaped(note) + "</p>\n";
  }
  text_ += "</div>\n";
}

int HtmlText::figure(const std::string& name, const std::string& svg, const std::string& title,
                     const std::string& caption) {
  text_ +=
      "<figure id=\"figure-" + html_escaped(name) + "\">\n" + inline_svg(svg, name, title) +
      "\n<figcaption><b>" + said("Figure {}", mark_ + std::to_string(++num_figures_)) + ". " +
      html_escaped(title) + ".</b> " + html_escaped(caption) + "</figcaption>\n</figure>\n";
  return num_figures_;
}

}  // namespace jnd::analysis
