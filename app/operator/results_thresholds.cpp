#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "analysis/fits/bounded_interval.h"
#include "analysis/fits/same_different_fit.h"
#include "analysis/results/threshold_answers.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/wilson_interval.h"
#include "app/operator/results_model.h"
#include "app/operator/study_words.h"
#include "core/psychometric_function.h"
#include "experiments/study/media.h"

namespace jnd::app {
namespace {

using namespace results;
using analysis::AdaptiveRun;
using analysis::BlockDesign;
using analysis::Estimate;
using analysis::ParticipantEstimate;

/// "95 % 0.18 to 0.26"; "" where both ends are open.
std::string bounded_interval_words(const analysis::Interval& whole,
                                   const std::optional<double>& value) {
  const analysis::Interval ci95 = analysis::bounded_by_data(whole, value);
  if (!ci95.low && !ci95.high) return "";
  if (!ci95.low) return fmt::format("95 % below {:.3g}", *ci95.high);
  if (!ci95.high) return fmt::format("95 % above {:.3g}", *ci95.low);
  return fmt::format("95 % {:.3g} to {:.3g}", *ci95.low, *ci95.high);
}

/// What the figures of a block show: the estimate, and how its value is written.
struct Shown {
  std::string section, estimate;
  bool is_fraction = false;  ///< A Weber fraction, which is no place among the levels.
};

Shown shown_of(const BlockDesign& block, const std::string& section) {
  if (section == block.block) {
    return block.detects() ? Shown{section, block.block + ".threshold"}
                           : Shown{section, block.block + ".weber_fraction", true};
  }
  if (block.rule != experiments::AdaptiveRule::kQuestPlus) {
    return {section, block.block + "." + block.procedure + "_threshold"};
  }
  return block.detects() ? Shown{section, block.block + ".quest_plus_threshold"}
                         : Shown{section, block.block + ".quest_plus_weber_fraction", true};
}

std::string value_words(const Shown& shown, double value, const std::string& unit) {
  // The primary value of such a block is that of the curves through its answers.
  const bool is_of_rule = shown.estimate.ends_with(".quest_plus_weber_fraction");
  if (shown.is_fraction)
    return fmt::format("w{} = {:.2f}", is_of_rule ? " by QUEST+" : "", value);
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

void add_value(ThresholdFigure& figure, const Shown& shown, const std::string& unit,
               const std::optional<double>& value, const analysis::Interval& ci95,
               const std::string& reason) {
  if (!value) {
    figure.reason = reason.empty() ? "no value" : reason;
    return;
  }
  figure.value = value_words(shown, *value, unit);
  figure.detail = bounded_interval_words(ci95, value);
  if (!shown.is_fraction) figure.line = value;
}

ThresholdFigure figure_of_everyone(const ResultsSource& source, const Shown& shown,
                                   const std::string& unit) {
  ThresholdFigure figure{.who = kEveryone};
  const Estimate* const found = source.results.find(shown.estimate);
  if (found == nullptr) {
    figure.reason = "nobody has a value";
  } else {
    add_value(figure, shown, unit, found->value, found->ci95, "");
    figure.caution = fmt::format("{}", fmt::join(found->cautions, "; "));
  }
  return figure;
}

ThresholdFigure figure_of(const ResultsSource& source, const std::string& participant,
                          const Shown& shown, const std::string& unit) {
  ThresholdFigure figure{.who = participant};
  const ParticipantEstimate* const own = source.own(shown.section, participant, shown.estimate);
  if (own == nullptr) {
    figure.reason = "no answers";
  } else {
    add_value(figure, shown, unit, own->value, own->ci95, own->reason);
    figure.caution = fmt::format("{}", fmt::join(own->cautions, "; "));
  }
  return figure;
}

std::vector<Proportion> proportions(const std::map<double, analysis::AnswerCount>& levels) {
  std::vector<Proportion> points;
  for (const auto& [intensity, row] : levels) {
    Proportion point{
        .intensity = intensity,
        .ratio = static_cast<double>(row.num_yes) / static_cast<double>(row.num_trials),
        .num_yes = row.num_yes,
        .num_trials = row.num_trials};
    std::tie(point.low, point.high) = analysis::wilson_interval(row.num_yes, row.num_trials);
    points.push_back(point);
  }
  return points;
}

/// The participant's own curve at these levels; empty where there is none.
std::vector<Point> curve_of(const ResultsSource& source, const BlockDesign& block,
                            const std::string& participant, const std::vector<double>& grid) {
  const auto own = [&](const std::string& name) {
    const ParticipantEstimate* const found =
        source.own(block.block, participant, block.block + "." + name);
    return found == nullptr ? std::nullopt : found->value;
  };
  const auto place = own(block.detects() ? "threshold" : "criterion_ln");
  const auto spread = own(block.detects() ? "spread_ln" : "weber_fraction");
  if (!place || !spread) return {};
  std::vector<Point> curve;
  for (const double x : grid) {
    const double y = block.detects()
                         ? core::standard_normal_cdf(std::log(x / *place) / *spread)
                         : analysis::different_probability(x, *block.reference_intensity,
                                                           *place, std::log1p(*spread));
    curve.push_back({x, y});
  }
  return curve;
}

Threshold threshold_of(const ResultsSource& source, const BlockDesign& block) {
  return {.block = block.block,
          .title = source.title(block.block),
          .quantity = experiments::quantity_words(block.quantity),
          .unit = experiments::quantity_unit(block.quantity),
          .answer = block.tells_apart() ? "“different”" : "“yes”",
          .has_fixed_levels = block.has_fixed_levels(),
          .reference = block.reference_intensity};
}

std::optional<Threshold> answers_of(const ResultsSource& source, const BlockDesign& block) {
  std::vector<analysis::ExcludedParticipant> without_answers;
  const std::vector<analysis::ThresholdAnswers> all =
      analysis::threshold_answers(source.data, block, false, without_answers);
  if (all.empty()) return std::nullopt;
  Threshold figure = threshold_of(source, block);
  const Shown shown = shown_of(block, block.block);
  std::map<double, analysis::AnswerCount> pooled;
  for (const analysis::ThresholdAnswers& one : all) {
    for (const auto& [intensity, row] : one.levels) {
      pooled[intensity].num_yes += row.num_yes;
      pooled[intensity].num_trials += row.num_trials;
    }
  }
  const std::vector<double> grid =
      logarithmic_grid(0.9 * pooled.begin()->first, 1.1 * pooled.rbegin()->first);
  figure.pooled = figure_of_everyone(source, shown, figure.unit);
  figure.pooled.points = proportions(pooled);
  for (const analysis::ThresholdAnswers& one : all) {
    ThresholdFigure own = figure_of(source, one.participant, shown, figure.unit);
    own.points = proportions(one.levels);
    own.curve = curve_of(source, block, one.participant, grid);
    figure.participants.push_back(std::move(own));
  }
  return figure;
}

std::vector<Track> tracks_of(const AdaptiveRun& run) {
  std::vector<Track> tracks;
  for (const analysis::AdaptiveTrack& track : run.tracks) {
    Track drawn;
    for (const analysis::TrackPoint& point : track.points) {
      const Point at{static_cast<double>(point.trial), point.level};
      drawn.levels.push_back(at);
      if (point.is_reversal) drawn.reversals.push_back(at);
    }
    tracks.push_back(std::move(drawn));
  }
  return tracks;
}

std::optional<Threshold> tracks_of(const ResultsSource& source, const BlockDesign& block) {
  Threshold figure = threshold_of(source, block);
  figure.has_tracks = true;
  const Shown shown = shown_of(block, block.block + "_" + block.procedure);
  figure.pooled = figure_of_everyone(source, shown, figure.unit);
  for (const AdaptiveRun& run : source.data.runs) {
    if (run.block != block.block) continue;
    figure.is_logarithmic = run.is_logarithmic;
    ThresholdFigure own = figure_of(source, run.participant, shown, figure.unit);
    own.tracks = tracks_of(run);
    figure.pooled.tracks.insert(figure.pooled.tracks.end(), own.tracks.begin(),
                                own.tracks.end());
    figure.participants.push_back(std::move(own));
  }
  return figure.participants.empty() ? std::nullopt : std::optional(figure);
}

}  // namespace

std::vector<Threshold> thresholds_of(const ResultsSource& source) {
  std::vector<Threshold> figures;
  for (const BlockDesign& block : source.data.blocks) {
    if (block.detects() || block.tells_apart()) {
      if (auto figure = answers_of(source, block)) figures.push_back(std::move(*figure));
    }
    if (block.is_adaptive()) {
      if (auto figure = tracks_of(source, block)) figures.push_back(std::move(*figure));
    }
  }
  return figures;
}

}  // namespace jnd::app
