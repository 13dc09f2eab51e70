#include <algorithm>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

using experiments::AdaptiveRule;

/// The estimate that a block computes by its own rule.
struct RuleEstimate {
  std::string section, name;
  /// Whether it is a Weber fraction, which has no place among the levels.
  bool is_fraction = false;
};

RuleEstimate estimate_of(const BlockDesign& block) {
  const std::string section = block.block + "_" + block.procedure;
  if (block.rule != AdaptiveRule::kQuestPlus) {
    return {section, block.block + "." + block.procedure + "_threshold"};
  }
  return block.detects()
             ? RuleEstimate{section, block.block + ".quest_plus_threshold"}
             : RuleEstimate{section, block.block + ".quest_plus_weber_fraction", true};
}

std::string value_words(const BlockDesign& block, const RuleEstimate& estimate,
                        const std::optional<double>& value) {
  // The primary value of such a block is that of the curves through its answers.
  if (estimate.is_fraction) return said("w by QUEST+ = {}", number_words(value, 2));
  const std::string unit = experiments::quantity_unit(block.quantity);
  return number_words(value) + (unit.empty() ? "" : " " + unit);
}

/// Adds every trial. Reversals of a staircase and the ends of series have their own columns.
void add_rows(FigureTable& table, const AdaptiveRun& run, int first_series) {
  const auto level_if = [](bool holds, double level) {
    return holds ? FigureCell(level) : FigureCell();
  };
  int series = first_series;
  for (const AdaptiveTrack& track : run.tracks) {
    for (const TrackPoint& point : track.points) {
      table.rows.push_back({series, run.participant, static_cast<double>(track.series),
                            static_cast<double>(point.trial), point.level, point.yes ? 1 : 0,
                            level_if(point.is_reversal, point.level),
                            level_if(point.is_averaged, point.level)});
    }
    ++series;
  }
}

experiments::RuleWords rule_words_of(const BlockDesign& block) {
  return experiments::procedure_named(block.procedure).rule_words();
}

std::string caption_of(const AdaptiveRun& run, const BlockDesign& block) {
  std::string words =
      said("Level of every trial. ") + said_with(rule_words_of(block).caption, {run.rule});
  if (block.reference_intensity) words += said(". Dashed: the reference");
  return words + ".";
}

void add_tracks(Chart& chart, const BlockDesign& block, int first_series, int num_series) {
  constexpr int kNumColours = 7;
  for (int i = 0; i < num_series; ++i) {
    const int colour = block.rule == AdaptiveRule::kStaircase ? i % kNumColours + 1 : 1;
    chart.series.push_back({.look = ChartSeries::Look::kTrack,
                            .series = first_series + i,
                            .x = "trial",
                            .y = "level",
                            .colour = colour});
    chart.series.push_back({.look = ChartSeries::Look::kReversals,
                            .series = first_series + i,
                            .x = "trial",
                            .y = "reversal",
                            .colour = colour});
  }
}

void add_lines(Chart& chart, const BlockDesign& block, const RuleEstimate& estimate,
               const std::optional<double>& value) {
  if (block.reference_intensity) {
    chart.lines.push_back({.at = *block.reference_intensity, .is_vertical = false});
  }
  if (value && !estimate.is_fraction) {
    chart.lines.push_back({.kind = ChartLine::Kind::kValue,
                           .at = *value,
                           .is_vertical = false,
                           .label = "threshold"});
  }
}

ChartSet set_of(const FigureSource& source, const BlockDesign& block,
                const std::vector<const AdaptiveRun*>& runs) {
  const std::string name = file_word(block.block) + "_tracks";
  const RuleEstimate estimate = estimate_of(block);
  const std::string title = source.titles.title_of(block.block);
  ChartSet set{
      .section = estimate.section,
      .heading = title,
      .panels = PanelFigures{.name = name,
                             .title = said_of(rule_words_of(block).tracks) + ", " + title,
                             .caption = caption_of(*runs.front(), block),
                             .num_columns = 3,
                             .most_panels = 12,
                             .panel_in = 1.3},
      .x = {.title = said("Trial"), .label = "trial"},
      .y = quantity_chart_axis(block.quantity, "test"),
      .tables = {{.name = name,
                  .columns = {"series", "participant", "track", "trial", "level", "yes",
                              "reversal", "averaged"}}},
      .everybody = Chart{.who = kEverybody}};
  std::vector<double> levels;
  std::int64_t last_trial = 1;
  int num_series = 0;
  for (const AdaptiveRun* run : runs) {
    const int first_series = num_series + 1;
    num_series += static_cast<int>(run->tracks.size());
    add_rows(set.tables.front(), *run, first_series);
    for (const AdaptiveTrack& track : run->tracks) {
      for (const TrackPoint& point : track.points) {
        levels.push_back(point.level);
        last_trial = std::max(last_trial, point.trial);
      }
    }
    Chart chart{.who = run->participant};
    add_tracks(chart, block, first_series, static_cast<int>(run->tracks.size()));
    add_tracks(*set.everybody, block, first_series, static_cast<int>(run->tracks.size()));
    const ParticipantEstimate* const own =
        source.own(estimate.section, run->participant, estimate.name);
    if (own == nullptr) {
      chart.reason = said("no answers");
    } else {
      add_value(chart, own->value, own->ci95, own->reason, own->cautions,
                value_words(block, estimate, own->value));
    }
    add_lines(chart, block, estimate, own == nullptr ? std::nullopt : own->value);
    set.participants.push_back(std::move(chart));
  }
  set.y.logarithmic = runs.front()->is_logarithmic;
  set.y.range = axis_range(levels, set.y.logarithmic);
  set.x.range = {0.0, static_cast<double>(last_trial) + 1.0};
  const Estimate* const found = source.results.find(estimate.name);
  if (found == nullptr) {
    set.everybody->reason = said("nobody has a value");
  } else {
    add_value(*set.everybody, found->value, found->ci95, "", found->cautions,
              value_words(block, estimate, found->value));
  }
  add_lines(*set.everybody, block, estimate, found == nullptr ? std::nullopt : found->value);
  return set;
}

}  // namespace

std::vector<ChartSet> track_charts(const FigureSource& source) {
  std::vector<ChartSet> sets;
  for (const BlockDesign& block : source.data.blocks) {
    std::vector<const AdaptiveRun*> runs;
    for (const AdaptiveRun& run : source.data.runs) {
      if (run.block == block.block && !run.tracks.empty()) runs.push_back(&run);
    }
    if (!runs.empty()) sets.push_back(set_of(source, block, runs));
  }
  return sets;
}

}  // namespace jnd::analysis
