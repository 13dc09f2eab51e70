#include "analysis/report/figure_files.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

#include "analysis/export/csv_table_writer.h"
#include "analysis/report/run_tool.h"
#include "core/error.h"
#include "core/parallel.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

void write_table(const FigureTable& table, const fs::path& folder, bool simulated) {
  std::vector<CsvColumn> columns;
  for (const std::string& name : table.columns) columns.push_back({name.c_str(), "", ""});
  if (simulated) columns.push_back({"simulated", "", ""});
  CsvTableWriter writer(folder / (table.name + ".csv"), columns);
  for (const std::vector<FigureCell>& row : table.rows) {
    for (const FigureCell& cell : row) {
      if (cell.number) {
        writer.cell(*cell.number);
      } else {
        writer.cell(cell.text);
      }
    }
    if (simulated) writer.cell(std::int64_t{1});
    writer.end_row();
  }
  writer.finish();
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Whether a file has its end. gnuplot does not report a full disk, so a file without its end
/// is rejected.
bool is_whole(const std::string& text, const char* end) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  const std::string_view closing = end;
  return last != std::string::npos && last + 1 >= closing.size() &&
         text.compare(last + 1 - closing.size(), closing.size(), closing) == 0;
}

void require_whole(const fs::path& file, const std::string& text, const char* end) {
  if (is_whole(text, end)) return;
  throw core::Error(file.string() +
                    ": expected gnuplot to write this file, found it without its end; is the "
                    "disk full?");
}

/// Adds fallbacks, so that another sans-serif font is used if Inter is not installed.
std::string with_other_fonts(const std::string& svg) {
  const std::string alone = "font-family=\"Inter\"";
  const std::string with_others = "font-family=\"Inter, Helvetica, Arial, sans-serif\"";
  std::string text;
  std::size_t from = 0;
  for (std::size_t at = svg.find(alone); at != std::string::npos; at = svg.find(alone, from)) {
    text.append(svg, from, at - from).append(with_others);
    from = at + alone.size();
  }
  return text.append(svg, from);
}

/// Removes the marks of bars that have none. gnuplot draws them at scale 0, and readers that
/// invert every scale, such as librsvg, then reject the whole picture.
std::string without_empty_marks(const std::string& svg) {
  std::string text;
  std::size_t from = 0;
  while (from < svg.size()) {
    const std::size_t end = std::min(svg.find('\n', from), svg.size() - 1) + 1;
    const std::string_view line = std::string_view(svg).substr(from, end - from);
    if (line.find(" scale(0.00)'") == std::string_view::npos) text += line;
    from = end;
  }
  return text;
}

DrawnFigure draw(const Figure& figure, const fs::path& folder, const FigureOptions& options) {
  DrawnFigure drawn{.name = figure.name};
  const ToolOutcome outcome = run_tool(options.gnuplot, {figure.name + ".gp"}, folder);
  const fs::path svg = folder / (figure.name + ".svg");
  const fs::path pdf = folder / (figure.name + ".pdf");
  if (outcome.ok) {
    drawn.svg = without_empty_marks(with_other_fonts(text_of(svg)));
    require_whole(svg, drawn.svg, "</svg>");
    write_text_file(svg, drawn.svg);
    require_whole(pdf, text_of(pdf), "%%EOF");
    set_pdf_dates(pdf, options.date_time_ns);
    return drawn;
  }
  drawn.problem = "gnuplot: " + outcome.problem;
  // Partly drawn files are removed.
  std::error_code ignored;
  fs::remove(svg, ignored);
  fs::remove(pdf, ignored);
  return drawn;
}

/// A time in the format of PDF dates, such as "20261120190123".
std::string pdf_digits(std::int64_t time_ns) {
  using namespace std::chrono;
  const auto moment = sys_time<nanoseconds>(nanoseconds(time_ns));
  const auto day = floor<days>(moment);
  const year_month_day date(day);
  const hh_mm_ss<seconds> time(floor<seconds>(moment - day));
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d%02u%02u%02d%02d%02d",
                static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()), static_cast<int>(time.hours().count()),
                static_cast<int>(time.minutes().count()),
                static_cast<int>(time.seconds().count()));
  return text.data();
}

}  // namespace

void write_text_file(const fs::path& file, const std::string& text) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  bool written = stream != nullptr;
  if (written) {
    written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    written = std::fclose(stream) == 0 && written;
  }
  if (written) return;
  throw core::Error(file.string() +
                    ": expected to write this file, found: " + std::strerror(errno));
}

void set_pdf_dates(const fs::path& file, std::int64_t time_ns) {
  std::string text = text_of(file);
  const std::string digits = pdf_digits(time_ns);
  for (const char* key :
       {"/CreationDate (D:", "/ModDate (D:", "/CreationDate(D:", "/ModDate(D:"}) {
    const std::string mark = key;
    for (std::size_t at = text.find(mark); at != std::string::npos;
         at = text.find(mark, at + 1)) {
      const std::size_t from = at + mark.size();
      if (from + digits.size() <= text.size()) text.replace(from, digits.size(), digits);
    }
  }
  write_text_file(file, text);
}

std::vector<DrawnFigure> write_figures(const std::vector<Figure>& figures,
                                       const fs::path& folder, const FigureOptions& options) {
  for (const Figure& figure : figures) {
    for (const FigureTable& table : figure.tables) {
      write_table(table, folder, options.simulated);
    }
    write_text_file(folder / (figure.name + ".gp"), gnuplot_script(figure, options.simulated));
  }
  std::vector<DrawnFigure> drawn(figures.size());
  if (options.gnuplot.empty()) {
    for (std::size_t i = 0; i < figures.size(); ++i) {
      drawn[i] = {.name = figures[i].name, .problem = "gnuplot is not installed"};
    }
    return drawn;
  }
  std::atomic<std::size_t> num_done = 0;
  core::for_each_index(figures.size(), options.jobs, [&](std::size_t i) {
    drawn[i] = draw(figures[i], folder, options);
    if (!options.on_progress) return;
    options.on_progress(static_cast<double>(++num_done) / static_cast<double>(figures.size()));
  });
  return drawn;
}

}  // namespace jnd::analysis
