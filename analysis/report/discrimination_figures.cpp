#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/fits/bounded_interval.h"
#include "analysis/fits/interval_order_fit.h"
#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/results/discrimination_group.h"
#include "analysis/results/report_words.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/summary.h"
#include "analysis/statistics/wilson_interval.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

struct LevelAnswers {
  std::int64_t num_yes = 0, num_trials = 0;
  [[nodiscard]] double ratio() const {
    return static_cast<double>(num_yes) / static_cast<double>(num_trials);
  }
};

/// Answers of one participant in one block.
struct OwnAnswers {
  std::string participant;
  std::map<double, LevelAnswers> levels;
  const ParticipantEstimate* fraction = nullptr;  ///< With the pse at the reference.
  const ParticipantEstimate* free_fraction = nullptr;
  const ParticipantEstimate* pse = nullptr;  ///< The pse of the fit with a free pse.
  double order_effect_ln = 0.0, free_order_effect_ln = 0.0;

  /// Of the two the one that stands for the primary value, which has the pse free or not.
  [[nodiscard]] const ParticipantEstimate* primary(bool frees) const {
    return frees ? free_fraction : fraction;
  }
};

struct BlockAnswers {
  std::string block, title, quantity;
  double reference = 0.0;
  std::vector<OwnAnswers> participants;  ///< Those who answered.
  std::vector<double> levels;            ///< Ascending.
  bool has_fixed_levels = true;          ///< See `BlockDesign`.
  bool frees = false;                    ///< The primary value has the pse free.
};

BlockAnswers answers_of(const FigureSource& source, const BlockDesign& block) {
  BlockAnswers all{.block = block.block,
                   .title = source.titles.title_of(block.block),
                   .quantity = block.quantity,
                   .has_fixed_levels = block.has_fixed_levels(),
                   .frees = source.section(block.block) != nullptr &&
                            source.section(block.block)->own_fractions_free_pse};
  std::map<double, int> levels;
  for (const ParticipantData& participant : source.data.participants) {
    OwnAnswers own{.participant = participant.participant};
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      if (!trial.intensity || !trial.response || !trial.reference_intensity) continue;
      all.reference = *trial.reference_intensity;
      LevelAnswers& level = own.levels[*trial.intensity];
      level.num_yes += *trial.response > 0.5 ? 1 : 0;
      ++level.num_trials;
      ++levels[*trial.intensity];
    }
    if (own.levels.empty()) continue;
    const auto value = [&](const std::string& name) {
      return source.own(block.block, participant.participant, block.block + "." + name);
    };
    own.fraction = value("weber_fraction");
    own.free_fraction = value("weber_fraction_free_pse");
    own.pse = value("pse");
    own.order_effect_ln = value_or_0(value("order_effect_ln_at_reference"));
    own.free_order_effect_ln = value_or_0(source.own(
        block.block + "_intervals", participant.participant, block.block + ".order_effect_ln"));
    all.participants.push_back(std::move(own));
  }
  for (const auto& [level, count] : levels) all.levels.push_back(level);
  return all;
}

bool have_orders(const BlockAnswers& answers) {
  return std::ranges::any_of(answers.participants, [](const OwnAnswers& own) {
    return own.order_effect_ln != 0.0 || own.free_order_effect_ln != 0.0;
  });
}

AxisRange intensity_range(const BlockAnswers& answers) {
  std::vector<double> values = answers.levels;
  values.push_back(answers.reference);
  AxisRange range = axis_range(values);
  range.low = std::max(range.low, 0.0);
  return range;
}

std::vector<std::pair<double, double>> curve(const BlockAnswers& answers, double pse,
                                             double fraction, double order_effect_ln) {
  const AxisRange range = intensity_range(answers);
  std::vector<std::pair<double, double>> points;
  constexpr int kPoints = 120;
  for (int i = 0; i <= kPoints; ++i) {
    const double intensity = range.low + (range.high - range.low) * i / kPoints;
    points.emplace_back(intensity, mean_over_orders(pse, fraction, order_effect_ln, intensity));
  }
  return points;
}

/// Everybody's answers, and the curve through those of each who has one.
FigureTable answers_table(const BlockAnswers& answers) {
  FigureTable table{.name = file_word(answers.block) + "_answers",
                    .columns = {"series", "participant", "intensity", "num_yes", "num_trials",
                                "ratio", "ratio_low", "ratio_high"}};
  int series = 0;
  for (const OwnAnswers& own : answers.participants) {
    ++series;
    for (const auto& [intensity, level] : own.levels) {
      const auto [low, high] = wilson_interval(level.num_yes, level.num_trials);
      table.rows.push_back({series, own.participant, intensity,
                            static_cast<double>(level.num_yes),
                            static_cast<double>(level.num_trials), level.ratio(), low, high});
    }
  }
  return table;
}

FigureTable curves_table(const BlockAnswers& answers) {
  FigureTable table{.name = file_word(answers.block) + "_curves",
                    .columns = {"series", "participant", "intensity", "ratio"}};
  int series = 0;
  for (const OwnAnswers& own : answers.participants) {
    ++series;
    if (own.fraction == nullptr || !own.fraction->value) continue;
    for (const auto& [intensity, ratio] :
         curve(answers, answers.reference, *own.fraction->value, own.order_effect_ln)) {
      table.rows.push_back({series, own.participant, intensity, ratio});
    }
  }
  return table;
}

bool has_free_curve(const OwnAnswers& own) {
  return own.free_fraction != nullptr && own.free_fraction->value && own.pse != nullptr &&
         own.pse->value && *own.pse->value > 0.0;
}

FigureTable free_curves_table(const BlockAnswers& answers) {
  FigureTable table{.name = file_word(answers.block) + "_curves_free_pse",
                    .columns = {"series", "participant", "intensity", "ratio"}};
  int series = 0;
  for (const OwnAnswers& own : answers.participants) {
    ++series;
    if (!has_free_curve(own)) continue;
    for (const auto& [intensity, ratio] :
         curve(answers, *own.pse->value, *own.free_fraction->value, own.free_order_effect_ln)) {
      table.rows.push_back({series, own.participant, intensity, ratio});
    }
  }
  return table;
}

FigureTable means_table(const BlockAnswers& answers) {
  FigureTable table{
      .name = file_word(answers.block) + "_means",
      .columns = {"intensity", "mean_ratio", "sd_ratio", "low", "high", "num_participants"}};
  for (const double intensity : answers.levels) {
    std::vector<double> ratios;
    for (const OwnAnswers& own : answers.participants) {
      const auto found = own.levels.find(intensity);
      if (found != own.levels.end()) ratios.push_back(found->second.ratio());
    }
    const Summary summary = summary_of(ratios);
    const double sd = summary.standard_deviation.value_or(0.0);
    table.rows.push_back({intensity, summary.mean, summary.standard_deviation,
                          std::max(*summary.mean - sd, 0.0), std::min(*summary.mean + sd, 1.0),
                          summary.num_values});
  }
  return table;
}

/// Of everybody together; the more answers, the larger the point.
FigureTable shares_table(const BlockAnswers& answers) {
  FigureTable table{.name = file_word(answers.block) + "_shares",
                    .columns = {"intensity", "num_yes", "num_trials", "ratio", "size"}};
  std::map<double, LevelAnswers> pooled;
  std::int64_t most = 1;
  for (const OwnAnswers& own : answers.participants) {
    for (const auto& [intensity, level] : own.levels) {
      LevelAnswers& sum = pooled[intensity];
      sum.num_yes += level.num_yes;
      sum.num_trials += level.num_trials;
      most = std::max(most, sum.num_trials);
    }
  }
  for (const auto& [intensity, level] : pooled) {
    const double share = static_cast<double>(level.num_trials) / static_cast<double>(most);
    table.rows.push_back({intensity, static_cast<double>(level.num_yes),
                          static_cast<double>(level.num_trials), level.ratio(),
                          0.2 + std::sqrt(share)});
  }
  return table;
}

std::string reference_line(const BlockAnswers& answers) {
  const std::string x = plot_number(answers.reference);
  return "  set arrow 1 from " + x + ",graph 0 to " + x + ",graph 1 nohead ls 12\n";
}

/// The primary value of the block, with the curve that it is of.
struct MedianPerson {
  const Estimate* fraction = nullptr;  ///< With a value, or there is no such person.
  double pse = 0.0, lapse_rate = 0.0;
};

MedianPerson median_person_of(const FigureSource& source, const BlockDesign& block,
                              double reference) {
  const auto find = [&](const char* name) {
    const Estimate* const found = source.results.find(block.block + "." + name);
    return found != nullptr && found->value ? found : nullptr;
  };
  std::vector<ExcludedParticipant> without_answers;
  const bool frees =
      primary_pse(discrimination_answers(source.data, block, false, without_answers)) ==
      HierarchicalPse::kPersonal;
  const Estimate* const pse = find("pse_median_person");
  return {.fraction = find("weber_fraction_median_person"),
          .pse = frees && pse != nullptr ? *pse->value : reference,
          .lapse_rate = value_or_0(find("lapse_rate"))};
}

/// "median person: w = 0.29 (0.21 .. 0.40)"
std::string median_person_words(const Estimate& fraction) {
  const int num_decimals = *fraction.value < 0.1 ? 3 : 2;
  std::string words = "median person: w = " + number_words(fraction.value, num_decimals);
  const Interval ci95 = bounded_by_data(fraction.ci95, fraction.value);
  if (!ci95.low || !ci95.high) return words;
  return words + " (" + number_words(ci95.low, num_decimals) + " .. " +
         number_words(ci95.high, num_decimals) + ")";
}

FigureTable median_person_table(const BlockAnswers& answers, const MedianPerson& person) {
  FigureTable table{.name = file_word(answers.block) + "_median_person",
                    .columns = {"intensity", "ratio"}};
  for (const auto& [intensity, ratio] :
       curve(answers, person.pse, *person.fraction->value, /*order_effect_ln=*/0.0)) {
    table.rows.push_back(
        {intensity, person.lapse_rate + (1.0 - 2.0 * person.lapse_rate) * ratio});
  }
  return table;
}

/// What a caption says of the curves of the group.
std::string curves_words(const FigureSource& source, const BlockAnswers& answers,
                         const MedianPerson& person, bool has_pooled, bool by_order) {
  std::string words;
  if (person.fraction != nullptr) {
    words = "Black: the curve of the median person (hierarchical fit), whose Weber fraction, " +
            with_interval(person.fraction->value, person.fraction->ci95) +
            ", is the primary value" +
            (by_order ? ", without anybody’s bias for an interval. " : ". ");
  }
  if (has_pooled) {
    const Estimate* const pooled = source.results.find(answers.block + ".weber_fraction");
    words += std::string("Orange, dashed: one curve through everybody’s answers (") +
             (by_order ? "maximum likelihood, each order of the intervals with a point of "
                         "subjective equality of its own, drawn as the mean of both"
                       : "least squares, point of subjective equality at the reference") +
             "), w = " + number_words(pooled->value, 3) + ": differences between people" +
             (by_order ? " and between the intervals" : "") +
             " flatten it, so that its Weber fraction is no person’s. ";
  } else {
    words += "The answers of everybody together have no curve. ";
  }
  return words;
}

/// Fig. 5 and D.23: the group's answers, its curve, everybody's curve behind.
Figure group_figure(const FigureSource& source, const BlockDesign& block,
                    const BlockAnswers& answers) {
  const bool free_pse = answers.frees;
  Figure figure{
      .name = file_word(answers.block) + "_psychometric",
      .section = answers.block,
      .title = "Psychometric function, " + answers.title,
      .thesis = "Fig. 5, D.6 and D.23",
      .width_in = 5.2,
      .height_in = 3.7,
      .tables = {answers.has_fixed_levels ? means_table(answers) : shares_table(answers),
                 free_pse ? free_curves_table(answers) : curves_table(answers)}};
  const Estimate* const pooled = source.results.find(answers.block + ".weber_fraction");
  const bool has_curve = pooled != nullptr && pooled->value;
  const Estimate* const effect =
      source.results.find(answers.block + ".weber_fraction_order_effect_ln");
  const bool by_order = effect != nullptr && effect->value;
  const double order_effect_ln = by_order ? *effect->value : 0.0;
  FigureTable group{.name = file_word(answers.block) + "_group_curve",
                    .columns = {"intensity", "ratio"}};
  if (has_curve) {
    for (const auto& [intensity, ratio] :
         curve(answers, answers.reference, *pooled->value, order_effect_ln)) {
      group.rows.push_back({intensity, ratio});
    }
  }
  const MedianPerson person = median_person_of(source, block, answers.reference);
  const AxisRange range = intensity_range(answers);
  figure.plot = "  set xrange " + range_words(range) + "\n  set yrange [-0.06:1.06]\n" +
                "  set xlabel " + gnuplot_quoted(quantity_axis(answers.quantity)) +
                "\n  set ylabel 'Proportion of answers “more”'\n" +
                "  set key outside top center reverse Left samplen 2\n" +
                reference_line(answers);
  std::string plot = "  plot ";
  const bool has_own_curves = !figure.tables[1].rows.empty();
  for (std::size_t i = 1; has_own_curves && i <= answers.participants.size(); ++i) {
    plot += from_table(figure.tables[1]) +
            "'intensity':" + if_series(static_cast<int>(i), "ratio") + " with lines ls 10, ";
  }
  if (person.fraction != nullptr) {
    figure.tables.push_back(median_person_table(answers, person));
    plot += from_table(figure.tables.back()) + "'intensity':'ratio' with lines ls 11 title " +
            gnuplot_quoted(median_person_words(*person.fraction)) + ", ";
  }
  if (has_curve) {
    const double at = answers.reference * (1.0 + *pooled->value);
    if (at < range.high && !by_order && is_of_thesis(source.results)) {
      const std::string x = plot_number(at);
      figure.plot += "  set arrow 2 from first " + x + ",graph 0 to first " + x +
                     ",first 0.8413 nohead ls 12\n  set arrow 3 from graph 0,first 0.8413 to "
                     "first " +
                     x + ",first 0.8413 nohead ls 12\n";
    }
    plot += from_table(group) +
            "'intensity':'ratio' with lines lc rgb '#D55E00' lw 1.4 dt 2 title " +
            gnuplot_quoted("one curve through everybody’s answers: w = " +
                           number_words(pooled->value, 3)) +
            ", ";
  }
  plot += from_table(figure.tables[0]) +
          (answers.has_fixed_levels
               ? "'intensity':'mean_ratio':'low':'high' with yerrorbars ls 11 lc rgb '#0072B2' "
                 "ps 0.8 title 'mean ± sd'\n"
               : "'intensity':'ratio':'size' with points pt 7 ps variable lc rgb '#0072B2' "
                 "title 'all answers'\n");
  // Named last: the eye begins with the median person.
  if (has_own_curves) {
    plot.pop_back();
    plot += ", NaN with lines ls 10 title 'each participant, fitted'\n";
  }
  figure.plot += plot;
  figure.caption =
      curves_words(source, answers, person, has_curve, by_order) +
      "Grey: each participant’s own (maximum likelihood, point of subjective equality " +
      (free_pse ? "free). Points: " : "at the reference). Points: ") +
      (answers.has_fixed_levels
           ? "mean proportion of answers “more than the reference” and standard deviation "
             "between "
           : "proportion of answers “more than the reference”, the larger a point the more "
             "answers, of ") +
      counted_words(std::ssize(answers.participants), "participant") + " at each level" +
      (answers.has_fixed_levels ? ", cut at 0 and 1. " : ". ") +
      "Dashed, vertical: the reference, " + number_words(answers.reference) + " " +
      experiments::quantity_unit(answers.quantity) +
      (has_curve && !by_order && is_of_thesis(source.results)
           ? ", and where the curve through everybody’s answers reaches 84.13 %."
           : ".");
  figure.tables.push_back(std::move(group));
  return figure;
}

/// D.5 and D.20, of everybody.
std::vector<Figure> participant_figures(const BlockAnswers& answers) {
  constexpr std::size_t kPanels = 20;
  std::vector<Figure> figures;
  const FigureTable points = answers_table(answers);
  const FigureTable curves = curves_table(answers);
  const FigureTable free_curves = free_curves_table(answers);
  for (std::size_t first = 0; first < answers.participants.size(); first += kPanels) {
    const std::size_t end = std::min(first + kPanels, answers.participants.size());
    const std::string part = first == 0 ? "" : "_" + std::to_string(first / kPanels + 1);
    Figure figure{.name = file_word(answers.block) + "_participants" + part,
                  .section = answers.block,
                  .title = "Answers of every participant, " + answers.title,
                  .thesis = "Fig. D.5 and D.20"};
    PanelGrid grid{.num_columns = 5,
                   .x_title = quantity_axis(answers.quantity),
                   .y_title = "Proportion of answers “more”",
                   .gap_x_in = 0.3};
    std::vector<Panel> panels;
    for (std::size_t i = first; i < end; ++i) {
      const OwnAnswers& own = answers.participants[i];
      const ParticipantEstimate* const primary = own.primary(answers.frees);
      const bool has_fraction = primary != nullptr && primary->value;
      const bool has_fixed_curve = own.fraction != nullptr && own.fraction->value;
      const int series = static_cast<int>(i) + 1;
      Panel panel{.title = own.participant + (has_fraction
                                                  ? "   w = " + number_words(primary->value, 2)
                                                  : "   no fit")};
      if (i == first) {
        panel.before = "  set xrange " + range_words(intensity_range(answers)) +
                       "\n  set yrange [-0.06:1.06]\n  set ytics 0.5 font small\n" +
                       small_tics("x", intensity_range(answers)) + reference_line(answers);
      }
      panel.plot = "plot ";
      const auto add_curve = [&](const FigureTable& table, bool is_primary) {
        panel.plot += from_table(table) + "'intensity':" + if_series(series, "ratio") +
                      (is_primary ? " with lines ls 11 lw 1.3, " : " with lines lt 2 lw 1.3, ");
      };
      if (has_fixed_curve) add_curve(curves, !answers.frees);
      if (has_free_curve(own)) add_curve(free_curves, answers.frees);
      panel.plot += from_table(points) + "'intensity':" + if_series(series, "ratio") +
                    (answers.has_fixed_levels
                         ? ":'ratio_low':'ratio_high' with yerrorbars ls 11 lc rgb '#0072B2' "
                           "lw 1 pt 7 ps 0.4"
                         : " with points pt 7 ps 0.3 lc rgb '#0072B2'");
      panels.push_back(std::move(panel));
    }
    figure.height_in = grid_height_in(grid, panels.size(), 1.15);
    figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
    figure.caption =
        std::string("Proportion of answers “more than the reference”") +
        (answers.has_fixed_levels ? " with Wilson’s 95 % interval" : "") +
        ", and the curves of maximum likelihood, where they exist: black, with its Weber "
        "fraction w, the point of subjective equality " +
        (answers.frees
             ? "free, as the primary value has it; dashed, it is at the reference. "
             : "at the reference, as the primary value has it; dashed, it is free. ") +
        std::string(have_orders(answers) ? "Drawn is the mean of both orders of the intervals. "
                                         : "") +
        "Vertical: the reference. The values of every participant say which curves the answers "
        "reject.";
    figure.tables = {points, curves};
    if (!free_curves.rows.empty()) figure.tables.push_back(free_curves);
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace

std::vector<Figure> discrimination_figures(const FigureSource& source) {
  std::vector<Figure> figures;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.compares()) continue;
    const BlockAnswers answers = answers_of(source, block);
    if (answers.participants.empty()) continue;
    figures.push_back(group_figure(source, block, answers));
    for (Figure& figure : participant_figures(answers)) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace jnd::analysis
