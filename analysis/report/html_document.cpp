#include "analysis/report/html_text.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// The style for the screen and for A4. No colour carries meaning, so a grey print says the
/// same.
constexpr char kPageStyle[] = R"css(
:root { color-scheme: light; }
* { box-sizing: border-box; }
html { background: #fff; color: #1b1b1b; }
body { font: 15px/1.5 Inter, "Helvetica Neue", Arial, sans-serif; max-width: 52rem;
  margin: 2rem auto; padding: 0 1.2rem; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 { font-size: 1.25rem; margin: 2.2rem 0 .6rem; padding-top: .5rem;
  border-top: 1px solid #999; }
h3 { font-size: 1.05rem; margin: 1.6rem 0 .4rem; }
h4 { font-size: .95rem; margin: 1.2rem 0 .3rem; }
p { margin: .5rem 0; }
.authors { color: #444; }
.banner { border: 2px solid #1b1b1b; padding: .5rem .8rem; font-weight: 600; }
.note { color: #444; font-size: .8rem; margin: .25rem 0; }
nav ul { columns: 2; list-style: none; padding: 0; font-size: .9rem; }
nav a { color: inherit; }
.table { margin: 1.1rem 0; overflow-x: auto; }
table { border-collapse: collapse; min-width: 45%; font-size: .8rem; line-height: 1.35;
  border-top: 1.5px solid #1b1b1b; border-bottom: 1.5px solid #1b1b1b; }
caption { text-align: left; font-size: .85rem; padding-bottom: .4rem; }
th { text-align: left; font-weight: 600; border-bottom: 1px solid #1b1b1b;
  vertical-align: bottom; }
th, td { padding: .22rem .45rem; }
th:first-child, td:first-child { padding-left: 0; }
td { vertical-align: top; }
tbody tr + tr td { border-top: 1px solid #e4e4e4; }
.meaning { color: #444; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
td.number { white-space: nowrap; }
code { font: .92em "JetBrains Mono", "DejaVu Sans Mono", monospace; }
figure { margin: 1.4rem 0; }
figure svg [font-family] { font-family: Inter, "Helvetica Neue", Arial, sans-serif; }
figure svg { display: block; max-width: 100%; height: auto; }
figcaption { font-size: .82rem; line-height: 1.4; margin-top: .3rem; }
@media print {
  html { font-size: 10pt; }
  body { font-size: 9.5pt; max-width: none; margin: 0; padding: 0; }
  h2, h3, h4, caption { break-after: avoid; }
  figure, tr, .short, .banner { break-inside: avoid; }
  thead { display: table-header-group; }
  tbody tr:nth-child(-n+2) { break-before: avoid; }
  .table { overflow: visible; }
  a { text-decoration: none; }
}
)css";

/// A text inside a CSS string.
std::string css_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\' || letter == '<') {
      quoted += letter == '<' ? "\\3C " : std::string("\\") + letter;
    } else if (static_cast<unsigned char>(letter) >= 0x20) {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

}  // namespace

std::string html_document(const std::string& title, const std::string& mark,
                          const std::string& body, const std::string& style) {
  std::string page =
      "@page { size: A4; margin: 18mm 17mm 20mm;\n"
      "  @bottom-right { content: counter(page) \" / \" counter(pages); font: 8pt Inter, "
      "sans-serif; }\n"
      "  @bottom-left { content: " +
      css_quoted(title) + "; font: 8pt Inter, sans-serif; }\n";
  if (!mark.empty()) {
    page += "  @top-right { content: " + css_quoted(mark) +
            "; font: 600 8pt Inter, sans-serif; }\n";
  }
  page += "}\n";
  return "<!DOCTYPE html>\n<html lang=\"" + spoken().code +
         "\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html_escaped(title) + "</title>\n<style>" + kPageStyle + style + page +
         "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

}  // namespace jnd::analysis
