#include "experiments/adaptive/method_of_limits.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/require.h"

namespace jnd::experiments {
namespace {

using core::require;

constexpr SeriesDirection kAscending = SeriesDirection::kAscending;
constexpr SeriesDirection kDescending = SeriesDirection::kDescending;

/// Returns how many levels a series can present.
std::size_t length_of(const PlannedSeries& planned, std::size_t num_levels) noexcept {
  return planned.direction == kAscending ? num_levels - planned.start : planned.start + 1;
}

std::vector<SeriesDirection> directions(const LimitsRule& rule, core::RandomStream& stream) {
  bool ascending = rule.order == SeriesOrder::kAscendingFirst;
  if (rule.order == SeriesOrder::kDrawnFirst || rule.order == SeriesOrder::kShuffled) {
    ascending = stream.below(2) == 0;
  }
  std::vector<SeriesDirection> found;
  for (int i = 0; i < rule.num_series; ++i, ascending = !ascending) {
    found.push_back(ascending ? kAscending : kDescending);
  }
  if (rule.order == SeriesOrder::kShuffled) stream.shuffle(found);
  return found;
}

}  // namespace

Limits::Limits(LimitsRule rule) : rule_(std::move(rule)) {
  const auto num_levels = static_cast<double>(rule_.levels.size());
  require(num_levels >= 2, "limits.levels", "two or more", num_levels);
  require_ascending(rule_.scale, "limits.levels", rule_.levels);
  require(rule_.num_series >= 1, "limits.num_series", "1 or more", rule_.num_series);
  require(rule_.max_start_offset >= 0 && rule_.max_start_offset < num_levels - 1,
          "limits.max_start_offset", "0 or more, and less than the number of levels minus one",
          rule_.max_start_offset);
  require(rule_.num_changed_in_a_row >= 1 &&
              rule_.num_changed_in_a_row < num_levels - rule_.max_start_offset,
          "limits.num_changed_in_a_row", "1 or more, and fewer than any series has levels",
          rule_.num_changed_in_a_row);
}

std::vector<PlannedSeries> Limits::drawn_series(core::RandomStream& stream) const {
  std::vector<PlannedSeries> plan;
  for (const SeriesDirection direction : directions(rule_, stream)) {
    const std::size_t offset = stream.below(rule_.max_start_offset + 1);
    const std::size_t last = rule_.levels.size() - 1;
    plan.push_back({direction, direction == kAscending ? offset : last - offset});
  }
  return plan;
}

LimitsSeries Limits::series_of(const PlannedSeries& planned,
                               std::span<const LevelAnswer> answers) const {
  LimitsSeries series{.direction = planned.direction};
  const bool changed = (planned.direction == kAscending) == rule_.yes_is_above;
  const auto length = static_cast<int>(length_of(planned, rule_.levels.size()));
  int num_changed = 0;  // Changed answers in a row.
  for (const auto& [level, yes] : answers) {
    require_level(rule_.scale, "limits.answers", level);
    ++series.num_trials;
    num_changed = yes == changed ? num_changed + 1 : 0;
    if (num_changed == rule_.num_changed_in_a_row) {
      const int first_changed = series.num_trials - num_changed;
      series.end = first_changed > 0 ? SeriesEnd::kTransition : SeriesEnd::kChangedAtStart;
      if (first_changed > 0) {
        series.transition = midpoint(rule_.scale, answers[first_changed - 1].level,
                                     answers[first_changed].level);
      }
      return series;
    }
    if (series.num_trials == length) {
      series.end = SeriesEnd::kNeverChanged;
      return series;
    }
  }
  return series;
}

double Limits::next_level(const PlannedSeries& planned, const LimitsSeries& series) const {
  require(planned.start < rule_.levels.size(), "limits.plan", "a start among the levels",
          static_cast<double>(planned.start));
  const auto steps = static_cast<std::size_t>(series.num_trials);
  return rule_
      .levels[planned.direction == kAscending ? planned.start + steps : planned.start - steps];
}

LimitsState Limits::after(const std::vector<PlannedSeries>& plan,
                          const std::vector<LevelAnswer>& answers) const {
  LimitsState state;
  std::span<const LevelAnswer> rest = answers;
  for (const PlannedSeries& planned : plan) {
    require(planned.start < rule_.levels.size(), "limits.plan", "a start among the levels",
            static_cast<double>(planned.start));
    const LimitsSeries series = series_of(planned, rest);
    if (series.num_trials > 0) state.series.push_back(series);
    if (series.end == SeriesEnd::kRunning) {
      state.next_level = next_level(planned, series);
      return state;
    }
    rest = rest.subspan(static_cast<std::size_t>(series.num_trials));
  }
  if (!rest.empty()) {
    throw core::Error("limits.answers: expected none after the last of " +
                      std::to_string(plan.size()) + " series, found " +
                      std::to_string(rest.size()));
  }
  return state;
}

LimitsState Limits::after_series(const std::vector<PlannedSeries>& plan,
                                 const std::vector<std::vector<LevelAnswer>>& answers) const {
  std::size_t num_begun = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i].empty()) num_begun = i + 1;
  }
  LimitsState state;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const std::span<const LevelAnswer> own = i < answers.size()
                                                 ? std::span<const LevelAnswer>(answers[i])
                                                 : std::span<const LevelAnswer>();
    const LimitsSeries series = series_of(plan[i], own);
    state.num_after_end += static_cast<int>(own.size()) - series.num_trials;
    if (i < num_begun) state.series.push_back(series);
    if (series.end != SeriesEnd::kRunning || i + 1 < num_begun) continue;
    state.next_level = next_level(plan[i], series);
    return state;
  }
  return state;
}

std::optional<double> Limits::mean_transition(const LimitsState& state,
                                              std::optional<SeriesDirection> direction) const {
  std::vector<double> transitions;
  for (const LimitsSeries& series : state.series) {
    if (!series.transition || (direction && series.direction != *direction)) continue;
    transitions.push_back(*series.transition);
  }
  if (transitions.empty()) return std::nullopt;
  return mean_level(rule_.scale, transitions);
}

LimitsThreshold Limits::threshold(const LimitsState& state) const {
  LimitsThreshold found{.level = mean_transition(state, std::nullopt),
                        .ascending = mean_transition(state, kAscending),
                        .descending = mean_transition(state, kDescending)};
  for (const LimitsSeries& series : state.series) {
    if (!series.transition) continue;
    ++(series.direction == kAscending ? found.num_ascending : found.num_descending);
  }
  if (found.ascending && found.descending) {
    found.constant_error =
        to_scale(rule_.scale, *found.ascending) - to_scale(rule_.scale, *found.descending);
  }
  return found;
}

}  // namespace jnd::experiments
