#include "analysis/report/plot_parts.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace jnd::analysis {

std::string plot_number(double value) {
  if (!std::isfinite(value)) return "NaN";
  char digits[32];
  char* const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  std::string text(digits, end);
  // gnuplot divides whole numbers without a remainder.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string from_table(const FigureTable& table) { return "'" + table.name + ".csv' using "; }

std::string if_series(const std::string& series_column, int series, const std::string& column) {
  return "(column('" + series_column + "')==" + std::to_string(series) + " ? column('" +
         column + "') : NaN)";
}

std::string if_series(int series, const std::string& column) {
  return if_series("series", series, column);
}

double largest_in(const FigureTable& table, const std::string& column) {
  const auto place = static_cast<std::size_t>(std::ranges::find(table.columns, column) -
                                              table.columns.begin());
  double largest = 0.0;
  for (const std::vector<FigureCell>& row : table.rows) {
    largest = std::max(largest, row[place].number.value_or(0.0));
  }
  return largest;
}

std::size_t num_letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char letter) { return (static_cast<unsigned char>(letter) & 0xC0U) != 0x80U; }));
}

std::string shortened(const std::string& text, std::size_t most_letters) {
  if (num_letters_of(text) <= most_letters) return text;
  std::string kept;
  std::size_t num = 0;
  for (const char letter : text) {
    if ((static_cast<unsigned char>(letter) & 0xC0U) != 0x80U && ++num >= most_letters) break;
    kept += letter;
  }
  while (kept.ends_with(' ')) kept.pop_back();
  return kept + "\u2026";
}

std::string on_two_lines(const std::string& text, std::size_t most_letters) {
  if (num_letters_of(text) <= most_letters || text.find('\n') != std::string::npos) return text;
  std::size_t end = std::string::npos;
  for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at + 1)) {
    if (num_letters_of(text.substr(0, at)) > most_letters) break;
    end = at;
  }
  if (end == std::string::npos) return shortened(text, most_letters);
  return text.substr(0, end) + '\n' + shortened(text.substr(end + 1), most_letters);
}

namespace {

/// Lines as one text of gnuplot. Each stands in single quotes, within which nothing is run.
std::string quoted_lines(const std::string& lines) {
  const std::size_t end = lines.find('\n');
  if (end == std::string::npos) return gnuplot_quoted(lines);
  return gnuplot_quoted(lines.substr(0, end)) + R"(."\n".)" +
         gnuplot_quoted(lines.substr(end + 1));
}

}  // namespace

double grid_height_in(const PanelGrid& grid, std::size_t num_panels, double panel_in) {
  const auto columns = static_cast<std::size_t>(grid.num_columns);
  const std::size_t num_rows = (num_panels + columns - 1) / columns;
  const auto rows = static_cast<double>(num_rows);
  return grid.top_in + grid.bottom_in + rows * panel_in + (rows - 1.0) * grid.gap_y_in;
}

std::string grid_plot(const PanelGrid& grid, const std::vector<Panel>& panels, double width_in,
                      double height_in) {
  const int columns = std::max(1, std::min(grid.num_columns, static_cast<int>(panels.size())));
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  // Panels in an incomplete row are as wide as the others.
  const int places = grid.num_columns;
  const double panel_width =
      (width_in - grid.left_in - grid.right_in - (places - 1) * grid.gap_x_in) / places;
  const double panel_height =
      (height_in - grid.top_in - grid.bottom_in - (rows - 1) * grid.gap_y_in) / rows;
  std::string script =
      "  set multiplot\n"
      "  set label 1 " +
      gnuplot_quoted(grid.x_title) + " at screen " +
      plot_number((grid.left_in + 0.5 * (width_in - grid.left_in - grid.right_in)) / width_in) +
      "," + plot_number(0.14 / height_in) + " center\n  set label 2 " +
      gnuplot_quoted(grid.y_title) + " at screen " + plot_number(0.12 / width_in) +
      ",0.5 center rotate by 90\n";
  const auto most_letters = static_cast<std::size_t>(
      std::max(8.0, (panel_width + 0.8 * grid.gap_x_in) / kSmallLetterIn));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const auto column = static_cast<double>(i % static_cast<std::size_t>(places));
    const std::size_t num_above = i / static_cast<std::size_t>(places);
    const auto row = static_cast<double>(num_above);
    const double left = grid.left_in + column * (panel_width + grid.gap_x_in);
    const double top = height_in - grid.top_in - row * (panel_height + grid.gap_y_in);
    script += "  set lmargin at screen " + plot_number(left / width_in) +
              "\n  set rmargin at screen " + plot_number((left + panel_width) / width_in) +
              "\n  set tmargin at screen " + plot_number(top / height_in) +
              "\n  set bmargin at screen " + plot_number((top - panel_height) / height_in) +
              "\n  set title " + quoted_lines(on_two_lines(panels[i].title, most_letters)) +
              " font small offset 0,-0.7\n";
    script += panels[i].before;
    script += "  " + panels[i].plot + "\n";
    // Labels on the whole figure are written once.
    if (i == 0) script += "  unset label 1\n  unset label 2\n  unset label 99\n";
  }
  return script + "  unset multiplot\n";
}

std::string range_words(const AxisRange& range) {
  return "[" + plot_number(range.low) + ":" + plot_number(range.high) + "]";
}

namespace {

/// A round step that fits into the range at most this often.
double round_step(const AxisRange& range, double most_steps) {
  const double least = (range.high - range.low) / most_steps;
  double step = least;
  if (least > 0.0 && std::isfinite(least)) {
    const double decade = std::pow(10.0, std::floor(std::log10(least)));
    step = 10.0 * decade;
    for (const double round : {5.0, 2.0, 1.0}) {
      if (round * decade >= least) step = round * decade;
    }
  }
  return step;
}

/// Round numbers within the range, with as few digits per decade as give at least `fewest`.
std::vector<double> places_of_decades(const AxisRange& range, std::size_t fewest) {
  const std::vector<std::vector<double>> digits_of_a_decade = {
      {1.0}, {1.0, 3.0}, {1.0, 2.0, 5.0}, {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}};
  const int first = static_cast<int>(std::floor(std::log10(range.low)));
  const int last = static_cast<int>(std::floor(std::log10(range.high)));
  std::vector<double> places;
  for (const std::vector<double>& digits : digits_of_a_decade) {
    places.clear();
    for (int decade = first; decade <= last; ++decade) {
      for (const double digit : digits) {
        // This division gives 0.15 exactly as it is written, which 1.5 * 0.1 would not.
        const double place =
            decade < 0 ? digit / std::pow(10.0, -decade) : digit * std::pow(10.0, decade);
        if (place >= range.low && place <= range.high) places.push_back(place);
      }
    }
    if (places.size() >= fewest) break;
  }
  return places;
}

/// Equal steps within the range.
std::vector<double> places_of_steps(const AxisRange& range) {
  const double step = round_step(range, 4.0);
  std::vector<double> places;
  for (double number = std::ceil(range.low / step); number * step <= range.high; ++number) {
    places.push_back(number * step);
  }
  return places;
}

}  // namespace

std::string small_tics(const std::string& axis, const AxisRange& range) {
  return "  set " + axis + "tics " + plot_number(round_step(range, 4.0)) + " font small\n";
}

std::string log_tics(const std::string& axis, const AxisRange& range, bool small) {
  const std::string end = small ? " font small\n" : "\n";
  const std::string start = "  set " + axis + "tics ";
  if (!(range.low > 0.0) || !(range.high > range.low) || !std::isfinite(range.high)) {
    return start + "autofreq" + end;
  }
  constexpr std::size_t kFewest = 3;
  std::vector<double> places = places_of_decades(range, kFewest);
  if (places.size() < kFewest) places = places_of_steps(range);
  const std::size_t most = small ? 4 : 6;
  const std::size_t step = (places.size() + most - 1) / most;
  std::string tics;
  for (std::size_t i = 0; i < places.size(); i += step) {
    tics += (tics.empty() ? "" : ", ") + plot_number(places[i]);
  }
  return start + "(" + tics + ")" + end;
}

std::string named_tics(const std::string& axis, const std::vector<std::string>& names,
                       bool upright) {
  std::string tics = "  set " + axis + "tics (";
  for (std::size_t i = 0; i < names.size(); ++i) {
    // gnuplot treats a tic label as a format.
    std::string label;
    for (const char letter : names[i]) label += letter == '%' ? "%%" : std::string(1, letter);
    tics += (i > 0 ? ", " : "") + gnuplot_quoted(label) + " " + std::to_string(i + 1);
  }
  tics += ")";
  if (upright) tics += " rotate by 90 right";
  return tics + "\n";
}

std::string box_plot_commands(const FigureTable& boxes, const FigureTable& values,
                              double width) {
  const std::string box_width = ":(" + plot_number(width) + ")";
  return from_table(boxes) +
         "'position':'lower_quartile':'lower_whisker':'upper_whisker':" + "'upper_quartile'" +
         box_width + " with candlesticks lc rgb '#333333' lw 1.2 fill empty whiskerbars 0.5, " +
         from_table(boxes) + "'position':'median':'median':'median':'median'" + box_width +
         " with candlesticks lc rgb '#D55E00' lw 2.5 dt 1 fill empty, " + from_table(values) +
         "(column('position')+" + plot_number(0.12 * width) +
         "*column('aside')):'value' with points pt 6 ps 0.45 lc rgb '#0072B2'";
}

}  // namespace jnd::analysis
