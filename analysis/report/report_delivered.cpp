#include "analysis/report/report_delivered.h"

#include <algorithm>

#include "analysis/report/plot_parts.h"
#include "analysis/report/report_results.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// One estimate by both intensities.
struct BothWays {
  const Estimate* commanded = nullptr;
  const Estimate* delivered = nullptr;
  std::string section;  ///< The section of the results.
};

std::vector<BothWays> both_ways(const StudyResults& commanded, const StudyResults& delivered) {
  std::vector<BothWays> all;
  for (const ResultsSection& section : delivered.sections) {
    for (const Estimate& estimate : section.estimates) {
      const Estimate* const other = commanded.find(estimate.name);
      if (!estimate.primary || !estimate.device_ci95.low || other == nullptr) continue;
      all.push_back({.commanded = other, .delivered = &estimate, .section = section.name});
    }
  }
  return all;
}

std::string device_words(const Estimate& estimate) {
  return said("{} to {}", number_words(estimate.device_ci95.low),
              number_words(estimate.device_ci95.high));
}

}  // namespace

void write_delivered(HtmlText& html, const StudyResults& commanded,
                     const DeliveredReport& delivered, const StudyTitles& titles) {
  const std::vector<BothWays> all = both_ways(commanded, delivered.results);
  if (all.empty()) return;
  html.heading(2, said("Commanded and delivered"));
  html.paragraph(
      said("Everything else in this report is by the intensities that were commanded. A device "
           "delivers something else: its force is not quite the one it is told, and its own "
           "damping opposes the hand as well. Both were measured before, so here the same is "
           "computed by what opposed the hand: gain times what was sent, and own damping. Dry "
           "friction is in neither."));
  html.list(delivered.devices);
  HtmlTable table{
      .caption = said("Primary values by intensities as commanded and as delivered, with 95 % "
                      "intervals over people; and what the measurement of the device alone "
                      "leaves open of the delivered one, 95 %"),
      .columns = {{said("Estimate"), false, true},
                  {said("Commanded"), true},
                  {said("Delivered"), true},
                  {said("Of the device"), true}}};
  for (const BothWays& one : all) {
    table.rows.push_back(
        {one.delivered->name + "\n" + section_title(titles, one.section),
         with_interval(one.commanded->name, one.commanded->value, one.commanded->ci95),
         with_interval(one.delivered->name, one.delivered->value, one.delivered->ci95),
         device_words(*one.delivered)});
  }
  table.notes = {
      said("Intensities of {} as delivered; {} left out, whose stimulus nobody measured.",
           counted_words(delivered.num_trials, "trial"),
           counted_words(delivered.num_left_out, "trial"))};
  html.table(table);
}

std::vector<Figure> delivered_figures(const StudyResults& commanded,
                                      const DeliveredReport& delivered,
                                      const StudyTitles& titles) {
  FigureTable table{
      .name = "delivered",
      .columns = {"position", "estimate", "commanded", "commanded_low", "commanded_high",
                  "delivered", "delivered_low", "delivered_high", "device_low", "device_high"}};
  std::vector<std::string> names;
  std::vector<double> values;
  for (const BothWays& one : both_ways(commanded, delivered.results)) {
    // The fraction is that of the group or of the median person, whichever is primary.
    if (one.delivered->name.find(".weber_fraction") == std::string::npos) continue;
    names.push_back(titles.short_title_of(one.section));
    table.rows.push_back({static_cast<int>(names.size()), one.delivered->name,
                          one.commanded->value, one.commanded->ci95.low,
                          one.commanded->ci95.high, one.delivered->value,
                          one.delivered->ci95.low, one.delivered->ci95.high,
                          one.delivered->device_ci95.low, one.delivered->device_ci95.high});
    for (const FigureCell& cell : table.rows.back()) {
      if (cell.number && &cell != &table.rows.back().front()) values.push_back(*cell.number);
    }
  }
  if (names.empty()) return {};
  const AxisRange range = axis_range(values, /*logarithmic=*/true);
  Figure figure{
      .name = "delivered",
      .section = "delivered",
      .title = said("Weber fractions, commanded and delivered"),
      .caption = said("Of the group, by intensities as commanded (circles) and as delivered "
                      "(squares), with 95 % intervals over people. Black diamonds beside the "
                      "squares: what the measurement of the device alone leaves open of it, 95 "
                      "%, often less than the mark is high. Logarithmic axis."),
      .width_in = std::min(6.6, 2.6 + 1.4 * static_cast<double>(names.size())),
      .height_in = 3.0};
  const auto bars = [&](const std::string& shift, const std::string& what,
                        const std::string& style) {
    return from_table(table) + "(column('position')" + shift + "):'" + what + "':'" + what +
           "_low':'" + what + "_high' with yerrorbars " + style;
  };
  figure.plot =
      "  set logscale y\n  set yrange " + range_words(range) + "\n" + log_tics("y", range) +
      "  set xrange [0.4:" + plot_number(static_cast<double>(names.size()) + 0.6) + "]\n" +
      named_tics("x", names, false) + "  set ylabel " + gnuplot_quoted(said("Weber fraction")) +
      "\n"
      "  set key outside top center horizontal reverse Left samplen 1.5\n"
      "  set bars 0.6\n  plot " +
      bars("-0.12", "commanded",
           "lt 1 dt 1 ps 0.9 title " + gnuplot_quoted(said("commanded"))) +
      ", " +
      bars("+0.06", "delivered",
           "lt 2 dt 1 ps 0.9 title " + gnuplot_quoted(said("delivered"))) +
      ", " + from_table(table) +
      "(column('position')+0.16):'delivered':'device_low':'device_high' with "
      "yerrorbars lt 5 dt 1 lw 1.5 pt 13 ps 0.7 title " +
      gnuplot_quoted(said("of the device")) + "\n";
  figure.tables = {std::move(table)};
  return {std::move(figure)};
}

}  // namespace jnd::analysis
