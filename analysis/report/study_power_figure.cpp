#include "analysis/report/study_power_figure.h"

#include <algorithm>

#include "analysis/report/plot_parts.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

std::string subtitle(const PowerFigureWords& words) {
  return said("{}, {} simulated studies of each size, laboratory {}", words.study,
              std::to_string(words.num_runs), words.laboratory);
}

std::string x_axis(const std::vector<PlannedSummary>& summaries) {
  std::vector<double> sizes;
  for (const PlannedSummary& one : summaries) sizes.push_back(one.num_participants);
  return "  set xlabel " + gnuplot_quoted(said("Participants")) + "\n  set xrange " +
         range_words(axis_range(sizes)) + "\n";
}

/// The series of a table, numbered from 1, as lines with marks and bars.
std::string series_plot(const FigureTable& table, const std::vector<PlannedName>& names,
                        const std::string& value, const std::string& low,
                        const std::string& high) {
  std::string plot = "  plot ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int series = static_cast<int>(i) + 1;
    const std::string type = " lt " + std::to_string(series);
    plot += (i == 0 ? "" : ", ") + from_table(table) +
            "'participants':" + if_series(series, value) + " with lines" + type + ", " +
            from_table(table) + "'participants':" + if_series(series, value) + ":'" + low +
            "':'" + high + "' with yerrorbars" + type + " dt 1 ps 0.8 title " +
            gnuplot_quoted(names[i].name);
  }
  return plot + "\n";
}

Figure power_figure(const PlannedAnalysis& analysis,
                    const std::vector<PlannedSummary>& summaries,
                    const PowerFigureWords& words) {
  const std::vector<PlannedName> names = test_names(analysis);
  FigureTable table{
      .name = "power",
      .columns = {"series", "test", "participants", "power", "power_low", "power_high"}};
  for (std::size_t test = 0; test < names.size(); ++test) {
    for (const PlannedSummary& one : summaries) {
      table.rows.push_back({static_cast<int>(test) + 1, names[test].name, one.num_participants,
                            one.tests[test].power, one.tests[test].power_low,
                            one.tests[test].power_high});
    }
  }
  Figure figure{.name = "power",
                .section = "power",
                .title = words.null_hypothesis ? said("False positives") : said("Power"),
                .caption = said("Share of simulated studies with p < 0.05; bars: 95 % "
                                "(Wilson), how well so many studies tell it.")};
  const std::string level = words.null_hypothesis ? "0.05" : "0.8";
  figure.plot = "  set title " + gnuplot_quoted(subtitle(words)) + " font small\n" +
                x_axis(summaries) + "  set ylabel " +
                gnuplot_quoted(said("Share with p < 0.05")) + "\n" +
                (words.null_hypothesis ? "  set yrange [0:0.2]\n" : "  set yrange [0:1]\n") +
                "  set key outside below left vertical reverse Left font small\n"
                "  set arrow 1 from graph 0,first " +
                level + " to graph 1,first " + level + " nohead ls 12\n  set bars 0.6\n" +
                series_plot(table, names, "power", "power_low", "power_high");
  figure.height_in = 3.4 + 0.2 * static_cast<double>(names.size());
  figure.tables = {std::move(table)};
  return figure;
}

Figure precision_figure(const PlannedAnalysis& analysis,
                        const std::vector<PlannedSummary>& summaries,
                        const PowerFigureWords& words) {
  const std::vector<PlannedName> names = estimate_names(analysis);
  FigureTable table{
      .name = "power_precision",
      .columns = {"series", "estimate", "participants", "half_width", "half_width_90"}};
  double largest = 0.0;
  for (std::size_t estimate = 0; estimate < names.size(); ++estimate) {
    for (const PlannedSummary& one : summaries) {
      const PlannedPrecision& precision = one.estimates[estimate];
      table.rows.push_back({static_cast<int>(estimate) + 1, names[estimate].name,
                            one.num_participants, precision.half_width_median,
                            precision.half_width_90});
      largest = std::max({largest, precision.half_width_median.value_or(0.0),
                          precision.half_width_90.value_or(0.0)});
    }
  }
  Figure figure{
      .name = "power_precision",
      .section = "power",
      .title = said("Precision"),
      .caption = said("Half width of the 95 % interval over participants: in the median study, "
                      "and up to what nine studies in ten stay below.")};
  figure.plot = "  set title " + gnuplot_quoted(subtitle(words)) + " font small\n" +
                x_axis(summaries) + "  set ylabel " +
                gnuplot_quoted(said("Half width of the 95 % interval")) + "\n" +
                "  set yrange [0:" + plot_number(largest > 0.0 ? 1.05 * largest : 1.0) +
                "]\n  set key outside below left vertical reverse Left font small\n"
                "  set bars 0.6\n" +
                series_plot(table, names, "half_width", "half_width", "half_width_90");
  figure.height_in = 3.4 + 0.2 * static_cast<double>(names.size());
  figure.tables = {std::move(table)};
  return figure;
}

}  // namespace

std::vector<Figure> power_figures(const PlannedAnalysis& analysis,
                                  const std::vector<PlannedSummary>& summaries,
                                  const PowerFigureWords& words) {
  std::vector<Figure> figures;
  if (analysis.compared) figures.push_back(power_figure(analysis, summaries, words));
  figures.push_back(precision_figure(analysis, summaries, words));
  return figures;
}

}  // namespace jnd::analysis
