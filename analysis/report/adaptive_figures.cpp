#include <algorithm>
#include <cmath>

#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/results/report_words.h"

namespace jnd::analysis {
namespace {

/// One participant's answers in a block, a line a track.
struct PlottedRun {
  const AdaptiveRun* run = nullptr;
  int first_series = 1;  ///< Of its tracks, counted over all participants.
};

std::vector<PlottedRun> runs_of(const StudyData& data, const std::string& block) {
  std::vector<PlottedRun> runs;
  int series = 1;
  for (const AdaptiveRun& run : data.runs) {
    if (run.block != block || run.tracks.empty()) continue;
    runs.push_back({&run, series});
    series += static_cast<int>(run.tracks.size());
  }
  return runs;
}

/// Every trial; what turned a staircase, and what ended a series, in columns of their own.
FigureTable tracks_table(const std::vector<PlottedRun>& runs, const std::string& block) {
  FigureTable table{.name = file_word(block) + "_tracks",
                    .columns = {"series", "participant", "track", "trial", "level", "yes",
                                "reversal", "averaged"}};
  const auto level_if = [](bool holds, double level) {
    return holds ? FigureCell(level) : FigureCell();
  };
  for (const PlottedRun& plotted : runs) {
    int series = plotted.first_series;
    for (const AdaptiveTrack& track : plotted.run->tracks) {
      for (const TrackPoint& point : track.points) {
        table.rows.push_back({series, plotted.run->participant,
                              static_cast<double>(track.series),
                              static_cast<double>(point.trial), point.level, point.yes ? 1 : 0,
                              level_if(point.is_reversal, point.level),
                              level_if(point.is_averaged, point.level)});
      }
      ++series;
    }
  }
  return table;
}

AxisRange level_range(const std::vector<PlottedRun>& runs, bool logarithmic) {
  std::vector<double> levels;
  for (const PlottedRun& plotted : runs) {
    for (const AdaptiveTrack& track : plotted.run->tracks) {
      for (const TrackPoint& point : track.points) levels.push_back(point.level);
    }
  }
  return axis_range(levels, logarithmic);
}

double last_trial(const std::vector<PlottedRun>& runs) {
  std::int64_t last = 1;
  for (const PlottedRun& plotted : runs) {
    for (const AdaptiveTrack& track : plotted.run->tracks) {
      for (const TrackPoint& point : track.points) last = std::max(last, point.trial);
    }
  }
  return static_cast<double>(last);
}

std::string horizontal(int number, double level, const std::string& style) {
  const std::string y = plot_number(level);
  return "  set arrow " + std::to_string(number) + " from graph 0,first " + y +
         " to graph 1,first " + y + " nohead " + style + "\n";
}

/// Settings of the first panel, which hold for the others.
std::string axes(const std::vector<PlottedRun>& runs, const BlockDesign& block) {
  const bool logarithmic = runs.front().run->is_logarithmic;
  const AxisRange trials{0.0, last_trial(runs) + 1.0};
  const AxisRange levels = level_range(runs, logarithmic);
  std::string words = "  set xrange " + range_words(trials) + "\n  set yrange " +
                      range_words(levels) + "\n" + small_tics("x", trials);
  words += logarithmic ? "  set logscale y\n" + log_tics("y", levels, /*small=*/true)
                       : small_tics("y", levels);
  if (block.reference_intensity) words += horizontal(1, *block.reference_intensity, "ls 12");
  return words;
}

Panel panel_of(const BlockDesign& block, const PlottedRun& plotted, const FigureTable& table) {
  const AdaptiveRun& run = *plotted.run;
  std::string title = run.participant;
  if (run.threshold) title += "   " + number_words(run.threshold);
  for (const PosteriorEstimate& one : run.posterior) {
    if (one.parameter == "threshold" || one.parameter == "weber_fraction") {
      title += (one.parameter == "threshold" ? "   " : "   w = ") + number_words(one.mean, 2);
    }
  }
  Panel panel{.title = title, .plot = "plot "};
  panel.before = run.threshold ? horizontal(2, *run.threshold, "ls 11 lw 1")
                               : std::string("  unset arrow 2\n");
  const auto count = static_cast<int>(run.tracks.size());
  for (int i = 0; i < count; ++i) {
    const int series = plotted.first_series + i;
    panel.plot += (i > 0 ? ", " : "") + from_table(table) +
                  "'trial':" + if_series(series, "level") + " with linespoints lt " +
                  std::to_string(block.rule == AdaptiveRule::kStaircase ? i % 7 + 1 : 1) +
                  " lw 1 pt 7 ps 0.25, " + from_table(table) +
                  "'trial':" + if_series(series, "reversal") + " with points lt 5 pt 6 ps 0.55";
  }
  return panel;
}

std::string caption_of(const std::vector<PlottedRun>& runs, const BlockDesign& block) {
  std::string words = "Level of every trial. ";
  const AdaptiveRun& run = *runs.front().run;
  if (block.rule == AdaptiveRule::kStaircase) {
    words += "A line is a staircase (" + run.rule +
             "), circles are its reversals; the horizontal line is the mean of the last "
             "reversals of all staircases, whose value stands in the title";
  } else if (block.rule == AdaptiveRule::kLimits) {
    words +=
        "A line is a series; the horizontal line is the mean of all transitions, whose "
        "value stands in the title";
  } else {
    words += "In the title: mean of the posterior at the end";
  }
  if (block.reference_intensity) words += ". Dashed: the reference";
  return words + ".";
}

std::string title_of(const BlockDesign& block) {
  if (block.rule == AdaptiveRule::kStaircase) return "Staircases";
  if (block.rule == AdaptiveRule::kLimits) return "Series of the method of limits";
  return "Stimuli of QUEST+";
}

std::vector<Figure> block_figures(const FigureSource& source, const BlockDesign& block,
                                  const std::vector<PlottedRun>& runs) {
  constexpr std::size_t kPanels = 12;
  std::vector<Figure> figures;
  const FigureTable table = tracks_table(runs, block.block);
  for (std::size_t first = 0; first < runs.size(); first += kPanels) {
    const std::size_t end = std::min(first + kPanels, runs.size());
    const std::string part = first == 0 ? "" : "_" + std::to_string(first / kPanels + 1);
    Figure figure{.name = file_word(block.block) + "_tracks" + part,
                  .section = block.block + "_" + block.procedure,
                  .title = title_of(block) + ", " + source.titles.title_of(block.block),
                  .caption = caption_of(runs, block),
                  .tables = {table}};
    PanelGrid grid{
        .num_columns = 3, .x_title = "Trial", .y_title = quantity_axis(block.quantity)};
    std::vector<Panel> panels;
    for (std::size_t i = first; i < end; ++i) {
      panels.push_back(panel_of(block, runs[i], table));
      if (i == first) panels.back().before += axes(runs, block);
    }
    figure.height_in = grid_height_in(grid, panels.size(), 1.3);
    figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace

std::vector<Figure> adaptive_figures(const FigureSource& source) {
  std::vector<Figure> figures;
  for (const BlockDesign& block : source.data.blocks) {
    const std::vector<PlottedRun> runs = runs_of(source.data, block.block);
    if (runs.empty()) continue;
    for (Figure& figure : block_figures(source, block, runs)) {
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

}  // namespace jnd::analysis
