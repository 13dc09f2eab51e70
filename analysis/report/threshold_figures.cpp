#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/fits/same_different_fit.h"
#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/results/report_words.h"
#include "analysis/results/threshold_answers.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/wilson_interval.h"
#include "core/psychometric_function.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

/// Answers of one participant, and the curve through them where there is one.
struct OwnCurve {
  ThresholdAnswers answers;
  std::function<double(double)> probability;  ///< Of "yes", or "different"; empty without one.
  std::string value;                          ///< For the title: "0.21 Pa s", "w = 0.31".
};

struct BlockCurves {
  const BlockDesign& block;
  std::vector<OwnCurve> participants;
  AxisRange range;
  bool has_fixed_levels = true;  ///< See `BlockDesign`.
};

std::optional<double> own_value(const FigureSource& source, const std::string& block,
                                const std::string& participant, const std::string& name) {
  const ParticipantEstimate* const own = source.own(block, participant, block + "." + name);
  return own == nullptr ? std::nullopt : own->value;
}

void add_detection_curve(const FigureSource& source, const BlockDesign& block, OwnCurve& own) {
  const std::string& who = own.answers.participant;
  const auto threshold = own_value(source, block.block, who, "threshold");
  const auto spread = own_value(source, block.block, who, "spread_ln");
  if (!threshold || !spread) return;
  own.value = number_words(threshold, 3) + " " + experiments::quantity_unit(block.quantity);
  own.probability = [mean = std::log(*threshold), sd = *spread](double intensity) {
    return core::standard_normal_cdf((std::log(intensity) - mean) / sd);
  };
}

void add_difference_curve(const FigureSource& source, const BlockDesign& block, OwnCurve& own) {
  const std::string& who = own.answers.participant;
  const auto fraction = own_value(source, block.block, who, "weber_fraction");
  const auto criterion = own_value(source, block.block, who, "criterion_ln");
  if (!fraction || !criterion) return;
  own.value = "w = " + number_words(fraction, 2);
  own.probability = [reference = own.answers.reference, k = *criterion,
                     sd = std::log1p(*fraction)](double intensity) {
    return different_probability(intensity, reference, k, sd);
  };
}

BlockCurves curves_of(const FigureSource& source, const BlockDesign& block) {
  BlockCurves curves{.block = block, .has_fixed_levels = block.has_fixed_levels()};
  std::vector<ExcludedParticipant> without_answers;
  std::vector<double> intensities;
  for (ThresholdAnswers& answers :
       threshold_answers(source.data, block, false, without_answers)) {
    for (const auto& [intensity, row] : answers.levels) intensities.push_back(intensity);
    OwnCurve own{.answers = std::move(answers)};
    if (block.detects()) {
      add_detection_curve(source, block, own);
    } else {
      add_difference_curve(source, block, own);
    }
    curves.participants.push_back(std::move(own));
  }
  curves.range = axis_range(intensities, /*logarithmic=*/true);
  return curves;
}

FigureTable answers_table(const BlockCurves& curves) {
  FigureTable table{.name = file_word(curves.block.block) + "_answers",
                    .columns = {"series", "participant", "intensity", "num_yes", "num_trials",
                                "ratio", "ratio_low", "ratio_high"}};
  int series = 0;
  for (const OwnCurve& own : curves.participants) {
    ++series;
    for (const AnswerCount& row : own.answers.rows_with_catches()) {
      const auto [low, high] = wilson_interval(row.num_yes, row.num_trials);
      table.rows.push_back(
          {series, own.answers.participant, row.intensity, static_cast<double>(row.num_yes),
           static_cast<double>(row.num_trials),
           static_cast<double>(row.num_yes) / static_cast<double>(row.num_trials), low, high});
    }
  }
  return table;
}

FigureTable curves_table(const BlockCurves& curves) {
  constexpr int kPoints = 120;
  FigureTable table{.name = file_word(curves.block.block) + "_curves",
                    .columns = {"series", "participant", "intensity", "ratio"}};
  int series = 0;
  for (const OwnCurve& own : curves.participants) {
    ++series;
    if (!own.probability) continue;
    for (int i = 0; i <= kPoints; ++i) {
      const double x = curves.range.low * std::pow(curves.range.high / curves.range.low,
                                                   static_cast<double>(i) / kPoints);
      table.rows.push_back({series, own.answers.participant, x, own.probability(x)});
    }
  }
  return table;
}

std::string rate_line(const AnswerCount& catches) {
  if (catches.num_trials == 0) return "  unset arrow 2\n";
  const std::string y = plot_number(static_cast<double>(catches.num_yes) /
                                    static_cast<double>(catches.num_trials));
  return "  set arrow 2 from graph 0,first " + y + " to graph 1,first " + y + " nohead ls 12\n";
}

std::string answer_words(const BlockDesign& block) {
  return block.detects() ? "“yes”" : "“different”";
}

Figure figure_of(const FigureSource& source, const BlockCurves& curves, std::size_t first,
                 std::size_t end) {
  constexpr std::size_t kPanels = 20;
  const BlockDesign& block = curves.block;
  const std::string part = first == 0 ? "" : "_" + std::to_string(first / kPanels + 1);
  Figure figure{.name = file_word(block.block) + "_participants" + part,
                .section = block.block,
                .title = "Answers of every participant, " + source.titles.title_of(block.block),
                .tables = {answers_table(curves), curves_table(curves)}};
  PanelGrid grid{.num_columns = 5,
                 .x_title = quantity_axis(block.quantity),
                 .y_title = "Proportion of answers " + answer_words(block),
                 .gap_x_in = 0.3};
  std::vector<Panel> panels;
  for (std::size_t i = first; i < end; ++i) {
    const OwnCurve& own = curves.participants[i];
    const int series = static_cast<int>(i) + 1;
    Panel panel{.title = own.answers.participant + "   " +
                         (own.probability ? own.value : std::string("no fit")),
                .before = rate_line(own.answers.catches)};
    if (i == first) {
      panel.before += "  set logscale x\n  set xrange " + range_words(curves.range) +
                      "\n  set yrange [-0.06:1.06]\n  set ytics 0.5 font small\n" +
                      log_tics("x", curves.range, /*small=*/true);
    }
    panel.plot = "plot ";
    if (own.probability) {
      panel.plot += from_table(figure.tables[1]) + "'intensity':" + if_series(series, "ratio") +
                    " with lines ls 11 lw 1.3, ";
    }
    panel.plot += from_table(figure.tables[0]) + "'intensity':" + if_series(series, "ratio") +
                  (curves.has_fixed_levels ? ":'ratio_low':'ratio_high' with yerrorbars ls 11 "
                                           : " with points ls 11 ") +
                  "lc rgb '#0072B2' lw 1 pt 7 ps 0.4";
    panels.push_back(std::move(panel));
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.15);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.caption = "Proportion of answers " + answer_words(block) +
                   (curves.has_fixed_levels ? " with Wilson’s 95 % interval"
                                            : " at every level that the answers led to") +
                   ", and the curve of maximum likelihood where it exists, "
                   "with " +
                   (block.detects() ? "the intensity felt in 50 %" : "its Weber fraction w") +
                   " in the title. Dashed: the same answer in catch trials.";
  return figure;
}

}  // namespace

std::vector<Figure> threshold_figures(const FigureSource& source) {
  constexpr std::size_t kPanels = 20;
  std::vector<Figure> figures;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.detects() && !block.tells_apart()) continue;
    const BlockCurves curves = curves_of(source, block);
    for (std::size_t first = 0; first < curves.participants.size(); first += kPanels) {
      figures.push_back(figure_of(source, curves, first,
                                  std::min(first + kPanels, curves.participants.size())));
    }
  }
  return figures;
}

}  // namespace jnd::analysis
