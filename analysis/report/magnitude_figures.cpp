#include <algorithm>
#include <cmath>

#include "analysis/charts/box_plot.h"
#include "analysis/charts/magnitude_data.h"
#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/results/number_words.h"
#include "analysis/statistics/comparison.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

constexpr const char* kMagnitudeAxis = said_later("Perceived magnitude (modulus = 1)");

/// The largest answer of a participant; 1 if none is above 0.
double largest(const MagnitudeData::Own& own) {
  double most = 0.0;
  for (const auto& [x, values] : own.values) {
    for (const double value : values) most = std::max(most, value);
  }
  return most > 0.0 ? most : 1.0;
}

/// Fig. D.8 for every participant.
std::vector<Figure> repetition_figures(const MagnitudeData& data) {
  constexpr std::size_t kPanels = 20;
  FigureTable table{
      .name = file_word(data.block) + "_repetitions",
      .columns = {"series", "participant", "repetition", "intensity", "magnitude"}};
  std::int64_t num_repetitions = 0;
  int series = 0;
  std::vector<double> intensities;
  for (const MagnitudeData::Own& own : data.participants) {
    ++series;
    for (const auto& [repetition, answers] : own.repetitions) {
      num_repetitions = std::max(num_repetitions, repetition);
      for (const auto& [intensity, magnitude] : answers) {
        intensities.push_back(intensity);
        table.rows.push_back(
            {series, own.participant, static_cast<double>(repetition), intensity, magnitude});
      }
    }
  }
  std::vector<Figure> figures;
  if (num_repetitions < 2) return figures;
  for (std::size_t first = 0; first < data.participants.size(); first += kPanels) {
    const std::size_t end = std::min(first + kPanels, data.participants.size());
    Figure figure{
        .name = file_word(data.block) + "_repetitions" +
                (first == 0 ? "" : "_" + std::to_string(first / kPanels + 1)),
        .section = data.block,
        .title = said("{}: repetitions of every participant", data.title),
        .caption = said("One line a repetition: first solid blue, second dashed orange, third "
                        "dotted green. Each panel has its own vertical scale."),
        .thesis = said("Fig. D.8")};
    PanelGrid grid{.num_columns = 5,
                   .x_title = quantity_axis(data.quantity),
                   .y_title = said(kMagnitudeAxis),
                   .gap_x_in = 0.36};
    std::vector<Panel> panels;
    for (std::size_t i = first; i < end; ++i) {
      Panel panel{.title = data.participants[i].participant};
      if (i == first) {
        panel.before = "  set xrange " + range_words(axis_range(intensities)) + "\n" +
                       small_tics("x", axis_range(intensities));
      }
      const AxisRange own{0.0, 1.08 * largest(data.participants[i])};
      panel.before += "  set yrange " + range_words(own) + "\n" + small_tics("y", own);
      panel.plot = "plot ";
      for (std::int64_t repetition = 1; repetition <= num_repetitions; ++repetition) {
        const std::string mine = "(column('series')==" + std::to_string(i + 1) +
                                 " && column('repetition')==" + std::to_string(repetition) +
                                 " ? column('magnitude') : NaN)";
        panel.plot += (repetition > 1 ? ", " : "") + from_table(table) + "'intensity':" + mine +
                      " with linespoints lt " + std::to_string((repetition - 1) % 7 + 1) +
                      " lw 1.2 ps 0.35";
      }
      panels.push_back(std::move(panel));
    }
    figure.height_in = grid_height_in(grid, panels.size(), 1.15);
    figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
    figure.tables = {table};
    figures.push_back(std::move(figure));
  }
  return figures;
}

/// Fig. D.10.
Figure estimation_boxes(const MagnitudeData& data) {
  std::vector<BoxGroup> groups;
  std::vector<std::string> names;
  for (const auto& [intensity, people] : data.by_x()) {
    names.push_back(shortest_words(intensity));
    groups.push_back({.label = names.back(),
                      .position = static_cast<double>(groups.size()) + 1.0,
                      .values = people});
  }
  Figure figure{.name = file_word(data.block) + "_boxes",
                .section = data.block,
                .title = said("{}: participants’ means", data.title),
                .caption = said("One circle a participant; boxes: quartiles and median, "
                                "whiskers to the last value within 1.5 interquartile ranges."),
                .thesis = said("Fig. D.10"),
                .width_in = 5.2,
                .height_in = 3.0};
  FigureTable boxes = box_table(file_word(data.block) + "_boxes", groups);
  FigureTable values = box_values_table(file_word(data.block) + "_box_values", groups);
  figure.plot = "  set xrange [0.4:" + plot_number(static_cast<double>(groups.size()) + 0.6) +
                "]\n" + named_tics("x", names, names.size() > 14) +
                "  set yrange [0:*]\n  set xlabel " +
                gnuplot_quoted(quantity_axis(data.quantity)) + "\n  set ylabel " +
                gnuplot_quoted(said(kMagnitudeAxis)) + "\n  plot " +
                box_plot_commands(boxes, values, 0.5) + "\n";
  figure.tables = {std::move(boxes), std::move(values)};
  return figure;
}

/// Fig. D.1, D.2 and D.11: the values that each participant set for each target.
Figure production_boxes(const MagnitudeData& data) {
  Figure figure{
      .name = file_word(data.block) + "_boxes",
      .section = data.block,
      .title = said("{}: values set by every participant", data.title),
      .caption = said(
          "One panel a magnitude that was asked for; one circle a production; boxes: quartiles "
          "and median, whiskers to the last value within 1.5 interquartile ranges."),
      .thesis = said("Fig. D.1, D.2 and D.11")};
  std::vector<std::string> names;
  for (const MagnitudeData::Own& own : data.participants) names.push_back(own.participant);
  PanelGrid grid{.num_columns = 1,
                 .x_title = said("Participant"),
                 .y_title = said("{}, as set", quantity_axis(data.quantity))};
  std::vector<Panel> panels;
  for (const auto& [target, people] : data.by_x()) {
    std::vector<BoxGroup> groups;
    for (std::size_t i = 0; i < data.participants.size(); ++i) {
      const auto found = data.participants[i].values.find(target);
      if (found == data.participants[i].values.end()) continue;
      BoxGroup group{.label = names[i], .position = static_cast<double>(i) + 1.0};
      for (const double value : found->second) group.values.emplace_back(names[i], value);
      groups.push_back(std::move(group));
    }
    const std::string percent = std::to_string(std::lround(100.0 * target));
    const std::string name = file_word(data.block) + "_" + percent;
    FigureTable boxes = box_table(name + "_boxes", groups);
    FigureTable values = box_values_table(name + "_values", groups);
    Panel panel{.title = said("set to feel like {} %", percent)};
    if (panels.empty()) {
      panel.before =
          "  set xrange [0.4:" + plot_number(static_cast<double>(names.size()) + 0.6) + "]\n" +
          named_tics("x", names, names.size() > 16) + "  set yrange [0:*]\n";
    }
    panel.plot = "plot " + box_plot_commands(boxes, values, 0.5);
    panels.push_back(std::move(panel));
    figure.tables.push_back(std::move(boxes));
    figure.tables.push_back(std::move(values));
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.5);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  return figure;
}

/// Fig. D.13.
std::optional<Figure> ratios_figure(const MagnitudeData& data) {
  std::vector<BoxGroup> groups;
  std::vector<std::string> names;
  const auto by_target = data.by_x();
  for (auto low = by_target.begin(); low != by_target.end(); ++low) {
    const auto high = std::next(low);
    if (high == by_target.end()) break;
    names.push_back(std::to_string(std::lround(100.0 * high->first)) + " % / " +
                    std::to_string(std::lround(100.0 * low->first)) + " %");
    BoxGroup group{.label = names.back(), .position = static_cast<double>(names.size())};
    for (const auto& below : low->second) {
      const auto above =
          std::find_if(high->second.begin(), high->second.end(),
                       [&below](const auto& one) { return one.first == below.first; });
      if (above != high->second.end() && below.second > 0.0) {
        group.values.emplace_back(below.first, above->second / below.second);
      }
    }
    groups.push_back(std::move(group));
  }
  FigureTable boxes = box_table(file_word(data.block) + "_ratio_boxes", groups);
  FigureTable values = box_values_table(file_word(data.block) + "_ratios", groups);
  if (boxes.rows.empty()) return std::nullopt;
  Figure figure{
      .name = file_word(data.block) + "_ratios",
      .section = data.block,
      .title = said("{}: ratios of set values", data.title),
      .caption = said("Mean value set for the larger over that for the smaller magnitude, one "
                      "circle a participant; dashed: the ratio of the magnitudes that were "
                      "asked for, where the two differ by a factor of 2."),
      .thesis = said("Fig. D.13"),
      .width_in = 3.6,
      .height_in = 3.0};
  figure.plot = "  set xrange [0.4:" + plot_number(static_cast<double>(names.size()) + 0.6) +
                "]\n" + named_tics("x", names, false) + "  set xlabel " +
                gnuplot_quoted(said("Magnitudes asked for")) + "\n" +
                "  set yrange [0:*]\n  set ylabel " +
                gnuplot_quoted(said("Ratio of set values")) +
                "\n  plot 2.0 with lines "
                "ls 12, " +
                box_plot_commands(boxes, values, 0.4) + "\n";
  figure.tables = {std::move(boxes), std::move(values)};
  return figure;
}

}  // namespace

std::vector<Figure> magnitude_figures(const FigureSource& source) {
  std::vector<Figure> figures;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.estimates() && !block.produces()) {
      continue;
    }
    const MagnitudeData data = magnitude_data(source, block);
    if (data.participants.empty()) continue;
    if (data.is_production) {
      figures.push_back(production_boxes(data));
      if (auto figure = ratios_figure(data)) figures.push_back(std::move(*figure));
    } else {
      figures.push_back(estimation_boxes(data));
      for (Figure& figure : repetition_figures(data)) figures.push_back(std::move(figure));
    }
  }
  return figures;
}

}  // namespace jnd::analysis
