#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/fits/same_different_fit.h"
#include "analysis/results/number_words.h"
#include "analysis/results/threshold_answers.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/wilson_interval.h"
#include "analysis/words/said.h"
#include "core/psychometric_function.h"
#include "experiments/procedures/task.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kAnswersTable = 0, kCurvesTable = 1, kPooledTable = 2;

/// P("yes"), or P("different"), at an intensity. It is empty if there is no curve.
using ThresholdCurve = std::function<double(double)>;

double guess_rate_of(const BlockDesign& block) {
  return 1.0 / experiments::num_choices_to_guess(task_of(block.written));
}

ThresholdCurve curve_of(const FigureSource& source, const BlockDesign& block,
                        const std::string& participant) {
  const auto own = [&](const std::string& name) {
    const ParticipantEstimate* const found =
        source.own(block.block, participant, block.block + "." + name);
    return found == nullptr ? std::nullopt : found->value;
  };
  if (block.identifies()) {
    const auto fraction = own("weber_fraction"), width = own("spread_ln");
    if (!fraction || !width) return {};
    const double guess = guess_rate_of(block);
    return [reference = *block.reference_intensity, mean = std::log(std::log1p(*fraction)),
            sd = *width, guess](double intensity) {
      const double distance = std::abs(std::log(intensity / reference));
      if (distance == 0.0) return guess;
      return guess +
             (1.0 - guess) * core::standard_normal_cdf((std::log(distance) - mean) / sd);
    };
  }
  const auto place = own(block.detects() ? "threshold" : "criterion_ln");
  const auto spread = own(block.detects() ? "spread_ln" : "weber_fraction");
  if (!place || !spread) return {};
  if (block.detects()) {
    return [mean = std::log(*place), sd = *spread](double intensity) {
      return core::standard_normal_cdf((std::log(intensity) - mean) / sd);
    };
  }
  return [reference = *block.reference_intensity, k = *place, sd = std::log1p(*spread)](
             double intensity) { return different_probability(intensity, reference, k, sd); };
}

std::string value_words(const BlockDesign& block, const std::optional<double>& value) {
  if (!block.detects()) return "w = " + number_words(value, 2);
  return number_words(value, 3) + " " + experiments::quantity_unit(block.quantity);
}

std::vector<FigureCell> answer_cells(const AnswerCount& row) {
  const auto [low, high] = wilson_interval(row.num_yes, row.num_trials);
  return {row.intensity,
          static_cast<double>(row.num_yes),
          static_cast<double>(row.num_trials),
          static_cast<double>(row.num_yes) / static_cast<double>(row.num_trials),
          low,
          high};
}

/// Adds a row to a table. `first` holds the cells that stand before it, such as the series and
/// the participant.
void add_row(FigureTable& table, std::vector<FigureCell> first, std::vector<FigureCell> cells) {
  first.insert(first.end(), std::make_move_iterator(cells.begin()),
               std::make_move_iterator(cells.end()));
  table.rows.push_back(std::move(first));
}

class ThresholdCharts {
 public:
  ThresholdCharts(const FigureSource& source, const BlockDesign& block)
      : source_(source), block_(block) {
    std::vector<ExcludedParticipant> without_answers;
    all_ = threshold_answers(source.data, block, false, without_answers);
  }

  [[nodiscard]] bool empty() const { return all_.empty(); }

  [[nodiscard]] ChartSet set() {
    const std::string name = file_word(block_.block);
    const std::string answer = block_.detects()      ? said("“yes”")
                               : block_.identifies() ? "right"
                                                     : said("“different”");
    const std::string title = source_.titles.title_of(block_.block);
    set_ = {.section = block_.block,
            .heading = title,
            .panels = PanelFigures{.name = name + "_participants",
                                   .title = said("Answers of every participant, {}", title),
                                   .caption = caption(answer)},
            .x = quantity_chart_axis(block_.quantity, "test"),
            .y = {.title = said("Proportion of {}", answer),
                  .label = said("{} in percent", answer),
                  .is_proportion = true,
                  .range = {0.0, 1.0}}};
    set_.tables = {
        {.name = name + "_answers",
         .columns = {"series", "participant", "intensity", "num_yes", "num_trials", "ratio",
                     "ratio_low", "ratio_high"}},
        {.name = name + "_curves", .columns = {"series", "participant", "intensity", "ratio"}},
        {.name = name + "_all_answers",
         .columns = {"intensity", "num_yes", "num_trials", "ratio", "ratio_low",
                     "ratio_high"}}};
    std::vector<double> intensities;
    for (const ThresholdAnswers& one : all_) {
      for (const auto& [intensity, row] : one.levels) intensities.push_back(intensity);
    }
    set_.x.logarithmic = true;
    set_.x.range = axis_range(intensities, /*logarithmic=*/true);
    for (const ThresholdAnswers& one : all_) add_participant(one);
    add_everybody();
    return std::move(set_);
  }

 private:
  [[nodiscard]] std::string caption(const std::string& answer) const {
    return said(
        "Proportion of answers {}{}, and the curve of maximum likelihood where it exists, with "
        "{} in the title. Dashed: {}",
        answer,
        (block_.has_fixed_levels() ? said(" with Wilson’s 95 % interval")
                                   : said(" at every level that the answers led to")),
        (block_.detects() ? said("the intensity felt in 50 %") : said("its Weber fraction w")),
        (block_.identifies() ? said("right by guessing.")
                             : said("the same answer in catch trials.")));
  }

  [[nodiscard]] ChartSeries answers(std::size_t table, std::optional<int> series) const {
    return {.look = block_.has_fixed_levels() ? ChartSeries::Look::kAnswers
                                              : ChartSeries::Look::kManyAnswers,
            .table = table,
            .series = series,
            .x = "intensity",
            .y = "ratio",
            .low = "ratio_low",
            .high = "ratio_high",
            .size = "num_trials"};
  }

  void add_lines(Chart& chart, const std::optional<double>& value,
                 const AnswerCount& catches) const {
    if (block_.reference_intensity) chart.lines.push_back({.at = *block_.reference_intensity});
    if (value && block_.detects()) {
      constexpr double kFeltInHalf = 0.5;
      chart.lines.push_back({.kind = ChartLine::Kind::kValue,
                             .at = *value,
                             .until = kFeltInHalf,
                             .label = "threshold"});
    }
    if (block_.identifies()) {
      chart.lines.push_back({.kind = ChartLine::Kind::kRate,
                             .at = guess_rate_of(block_),
                             .is_vertical = false,
                             .label = "guessing"});
    } else if (catches.num_trials > 0) {
      chart.lines.push_back(
          {.kind = ChartLine::Kind::kRate,
           .at = static_cast<double>(catches.num_yes) / static_cast<double>(catches.num_trials),
           .is_vertical = false,
           .label = said("catch trials")});
    }
  }

  void add_participant(const ThresholdAnswers& one) {
    constexpr int kPoints = 120;
    const int series = static_cast<int>(set_.participants.size()) + 1;
    for (const AnswerCount& row : block_.identifies() ? one.rows() : one.rows_with_catches()) {
      add_row(set_.tables[kAnswersTable], {series, one.participant}, answer_cells(row));
    }
    Chart chart{.who = one.participant};
    const ParticipantEstimate* const own =
        source_.own(block_.block, one.participant,
                    block_.block + (block_.detects() ? ".threshold" : ".weber_fraction"));
    if (const ThresholdCurve curve = curve_of(source_, block_, one.participant)) {
      for (int i = 0; i <= kPoints; ++i) {
        const double x = set_.x.range.low * std::pow(set_.x.range.high / set_.x.range.low,
                                                     static_cast<double>(i) / kPoints);
        set_.tables[kCurvesTable].rows.push_back({series, one.participant, x, curve(x)});
      }
      chart.series.push_back(
          {.table = kCurvesTable, .series = series, .x = "intensity", .y = "ratio"});
    }
    chart.series.push_back(answers(kAnswersTable, series));
    if (own == nullptr) {
      chart.reason = said("no answers");
    } else {
      add_value(chart, own->value, own->ci95, own->reason, own->cautions,
                value_words(block_, own->value));
    }
    add_lines(chart, own == nullptr ? std::nullopt : own->value, one.catches);
    set_.participants.push_back(std::move(chart));
  }

  void add_everybody() {
    std::map<double, AnswerCount> levels;
    AnswerCount catches;
    for (const ThresholdAnswers& one : all_) {
      for (const auto& [intensity, row] : one.levels) {
        levels[intensity].intensity = intensity;
        levels[intensity].num_yes += row.num_yes;
        levels[intensity].num_trials += row.num_trials;
      }
      catches.num_yes += one.catches.num_yes;
      catches.num_trials += one.catches.num_trials;
    }
    for (const auto& [intensity, row] : levels) {
      set_.tables[kPooledTable].rows.push_back(answer_cells(row));
    }
    Chart chart{.who = kEverybody, .series = {answers(kPooledTable, std::nullopt)}};
    const Estimate* const found = source_.results.find(
        block_.block + (block_.detects() ? ".threshold" : ".weber_fraction"));
    if (found == nullptr) {
      chart.reason = said("nobody has a value");
    } else {
      add_value(chart, found->value, found->ci95, "", found->cautions,
                value_words(block_, found->value));
    }
    add_lines(chart, found == nullptr ? std::nullopt : found->value, catches);
    set_.everybody = std::move(chart);
  }

  const FigureSource& source_;
  const BlockDesign& block_;
  std::vector<ThresholdAnswers> all_;
  ChartSet set_;
};

}  // namespace

std::vector<ChartSet> threshold_charts(const FigureSource& source) {
  std::vector<ChartSet> sets;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.detects() && !block.tells_apart() && !block.identifies()) continue;
    ThresholdCharts charts(source, block);
    if (!charts.empty()) sets.push_back(charts.set());
  }
  return sets;
}

}  // namespace jnd::analysis
