#include "experiments/adaptive/staircase.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/require.h"

namespace jnd::experiments {
namespace {

using core::require;

void require_levels(const StaircaseRule& rule) {
  require_level(rule.scale, "staircase.lowest", rule.lowest);
  require_level(rule.scale, "staircase.highest", rule.highest);
  // The words are made only for an error, because a rule is checked in every trial.
  if (!(rule.highest > rule.lowest)) {
    require(false, "staircase.highest",
            "a level above the lowest (" + level_words(rule.lowest) + ")", rule.highest);
  }
  if (!(rule.start >= rule.lowest && rule.start <= rule.highest)) {
    require(false, "staircase.start",
            "a level from the lowest (" + level_words(rule.lowest) + ") to the highest (" +
                level_words(rule.highest) + ")",
            rule.start);
  }
  require_ascending(rule.scale, "staircase.grid", rule.grid);
  if (rule.grid.empty()) return;
  require(rule.grid.size() >= 2, "staircase.grid", "two levels or more", rule.grid.front());
  require(rule.grid.front() >= rule.lowest, "staircase.grid", "levels within the bounds",
          rule.grid.front());
  require(rule.grid.back() <= rule.highest, "staircase.grid", "levels within the bounds",
          rule.grid.back());
  require(std::find(rule.grid.begin(), rule.grid.end(), rule.start) != rule.grid.end(),
          "staircase.start", "a level of the grid", rule.start);
}

void require_counts(const StaircaseRule& rule) {
  require(rule.num_up >= 1, "staircase.num_up", "1 or more", rule.num_up);
  require(rule.num_down >= 1, "staircase.num_down", "1 or more", rule.num_down);
  require(!rule.step_sizes.empty(), "staircase.step_sizes", "one or more", 0.0);
  for (const double step : rule.step_sizes) {
    require(step > 0.0 && std::isfinite(step), "staircase.step_sizes", "steps > 0", step);
  }
  require(rule.down_per_up_ratio > 0.0 && std::isfinite(rule.down_per_up_ratio),
          "staircase.down_per_up_ratio", "a ratio > 0", rule.down_per_up_ratio);
  require(rule.max_trials >= 1, "staircase.max_trials", "1 or more", rule.max_trials);
  const int reversals = rule.max_reversals.value_or(1);
  require(reversals >= 1, "staircase.max_reversals", "1 or more", reversals);
  const int blocked = rule.max_blocked_in_a_row.value_or(1);
  require(blocked >= 1, "staircase.max_blocked_in_a_row", "1 or more", blocked);
  const int averaged = rule.num_reversals_averaged;
  require(averaged >= 2 && averaged % 2 == 0, "staircase.num_reversals_averaged",
          "an even number, 2 or more", averaged);
  if (averaged > rule.max_reversals.value_or(averaged)) {
    require(false, "staircase.num_reversals_averaged",
            "no more than `max_reversals` (" + std::to_string(*rule.max_reversals) + ")",
            averaged);
  }
}

/// Returns the probability that `num_down` lowering answers in a row come before `num_up`
/// raising ones.
double down_before_up_probability(double p, int num_up, int num_down) {
  const double down = std::pow(p, num_down - 1);
  const double up = std::pow(1.0 - p, num_up - 1);
  return down * (1.0 - up * (1.0 - p)) / (down + up - down * up);
}

std::size_t nearest(const std::vector<double>& grid, LevelScale scale, double level) noexcept {
  const auto distance = [&](double other) {
    return std::abs(to_scale(scale, other) - to_scale(scale, level));
  };
  const auto found = std::min_element(
      grid.begin(), grid.end(), [&](double a, double b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(found - grid.begin());
}

}  // namespace

Staircase::Staircase(StaircaseRule rule) : rule_(std::move(rule)) {
  require_levels(rule_);
  require_counts(rule_);
  if (!rule_.grid.empty()) {
    rule_.lowest = rule_.grid.front();
    rule_.highest = rule_.grid.back();
  }
  rounding_ = 1e-9 * std::min(1.0, rule_.down_per_up_ratio) *
              *std::min_element(rule_.step_sizes.begin(), rule_.step_sizes.end());
}

bool Staircase::is_at_bottom(double level) const noexcept {
  const double bottom = to_scale(rule_.scale, rule_.lowest);
  return to_scale(rule_.scale, level) <= bottom + rounding_;
}

bool Staircase::is_at_top(double level) const noexcept {
  const double top = to_scale(rule_.scale, rule_.highest);
  return to_scale(rule_.scale, level) >= top - rounding_;
}

double Staircase::allowed(double level) const noexcept {
  if (!rule_.grid.empty()) return rule_.grid[nearest(rule_.grid, rule_.scale, level)];
  if (is_at_bottom(level)) return rule_.lowest;
  return is_at_top(level) ? rule_.highest : level;
}

double Staircase::stepped(double level, bool down, std::size_t num_reversals) const {
  const double size = rule_.step_sizes[std::min(num_reversals, rule_.step_sizes.size() - 1)];
  const double step = down ? -size * rule_.down_per_up_ratio : size;
  const double wanted = from_scale(rule_.scale, to_scale(rule_.scale, level) + step);
  if (rule_.grid.empty()) return allowed(wanted);
  const std::size_t here = nearest(rule_.grid, rule_.scale, level);
  const std::size_t there = nearest(rule_.grid, rule_.scale, wanted);
  if (there != here) return rule_.grid[there];
  // Even a step shorter than half the way to the next level moves by one level.
  if (down) return rule_.grid[here > 0 ? here - 1 : 0];
  return rule_.grid[std::min(here + 1, rule_.grid.size() - 1)];
}

StaircaseState Staircase::after(const std::vector<LevelAnswer>& answers) const {
  StaircaseState state{.next_level = rule_.start};
  Run run;
  for (const auto& [level, yes] : answers) {
    require_level(rule_.scale, "staircase.answers", level);
    if (state.is_finished()) {
      ++state.num_after_end;
      continue;
    }
    const bool lowering = yes == rule_.yes_lowers;
    run.num_lowering = lowering ? run.num_lowering + 1 : 0;
    run.num_raising = lowering ? 0 : run.num_raising + 1;
    state.next_level = allowed(level);
    if (run.num_lowering == rule_.num_down || run.num_raising == rule_.num_up) {
      run.num_lowering = run.num_raising = 0;
      move(level, lowering, run, state);
    }
    ++run.num_trials;
    state.end = end_of(run, state);
  }
  return state;
}

void Staircase::move(double level, bool down, Run& run, StaircaseState& state) const {
  if (down ? is_at_bottom(level) : is_at_top(level)) {
    ++state.num_blocked;
    ++run.num_blocked_in_a_row;
    return;
  }
  const int direction = down ? -1 : 1;
  if (run.last_direction == -direction) {
    state.reversals.push_back(
        {run.num_trials, level, down ? is_at_top(level) : is_at_bottom(level)});
  }
  run.num_blocked_in_a_row = 0;
  run.last_direction = direction;
  state.next_level = stepped(level, down, state.reversals.size());
}

StaircaseEnd Staircase::end_of(const Run& run, const StaircaseState& state) const noexcept {
  const auto reaches = [](std::size_t count, int most) {
    return count >= static_cast<std::size_t>(most);
  };
  if (rule_.max_reversals && reaches(state.reversals.size(), *rule_.max_reversals)) {
    return StaircaseEnd::kReversals;
  }
  if (rule_.max_blocked_in_a_row && run.num_blocked_in_a_row >= *rule_.max_blocked_in_a_row) {
    return StaircaseEnd::kBlocked;
  }
  return reaches(run.num_trials, rule_.max_trials) ? StaircaseEnd::kTrials
                                                   : StaircaseEnd::kNotFinished;
}

StaircaseThreshold Staircase::threshold(const StaircaseState& state) const {
  const std::size_t available = state.reversals.size() - state.reversals.size() % 2;
  const std::size_t used =
      std::min(available, static_cast<std::size_t>(rule_.num_reversals_averaged));
  StaircaseThreshold found{.num_reversals = static_cast<int>(used)};
  if (used == 0) return found;
  std::vector<double> levels;
  for (std::size_t i = state.reversals.size() - used; i < state.reversals.size(); ++i) {
    levels.push_back(state.reversals[i].level);
    found.num_at_bound += state.reversals[i].at_bound ? 1 : 0;
  }
  found.level = mean_level(rule_.scale, levels);
  return found;
}

double Staircase::target_probability() const {
  return staircase_target_probability(rule_.num_up, rule_.num_down, rule_.down_per_up_ratio);
}

double staircase_target_probability(int num_up, int num_down, double down_per_up_ratio) {
  require(num_up >= 1, "staircase.num_up", "1 or more", num_up);
  require(num_down >= 1, "staircase.num_down", "1 or more", num_down);
  require(down_per_up_ratio > 0.0 && std::isfinite(down_per_up_ratio),
          "staircase.down_per_up_ratio", "a ratio > 0", down_per_up_ratio);
  const double wanted = 1.0 / (1.0 + down_per_up_ratio);
  double low = 0.0, high = 1.0;
  // The probability rises with p. The interval is halved until its ends are neighbouring
  // numbers.
  while (true) {
    const double p = 0.5 * (low + high);
    if (p <= low || p >= high) return p;
    (down_before_up_probability(p, num_up, num_down) < wanted ? low : high) = p;
  }
}

double staircase_step_ratio(double target_probability, int num_up, int num_down) {
  require(target_probability > 0.0 && target_probability < 1.0, "staircase.target_probability",
          "a probability in (0, 1)", target_probability);
  require(num_up >= 1, "staircase.num_up", "1 or more", num_up);
  require(num_down >= 1, "staircase.num_down", "1 or more", num_down);
  const double down = down_before_up_probability(target_probability, num_up, num_down);
  return (1.0 - down) / down;
}

double expected_staircase_trials(const StaircaseRule& rule, double threshold, double spread) {
  const double ratio = rule.down_per_up_ratio;
  const double p = staircase_target_probability(rule.num_up, rule.num_down, ratio);
  const double z = core::standard_normal_quantile(p);
  const auto down = [&](double shift) {
    const double raised = core::standard_normal_cdf(z + shift);
    return down_before_up_probability(raised, rule.num_up, rule.num_down);
  };
  constexpr double kShift = 1e-4;
  const double rise = (down(kShift) - down(-kShift)) / (2.0 * kShift * spread);
  const double d = std::pow(p, rule.num_down), u = std::pow(1.0 - p, rule.num_up);
  const double verdict_trials = (1.0 - d) * (1.0 - u) / (d * (1.0 - p) + p * u - d * u);
  const double middle =
      std::clamp(to_scale(rule.scale, threshold) + z * spread,
                 to_scale(rule.scale, rule.lowest), to_scale(rule.scale, rule.highest));
  const double way = to_scale(rule.scale, rule.start) - middle;
  const double first = rule.step_sizes.front();
  double num_trials =
      way > 0.0 ? way / (first * ratio) * rule.num_down : -way / first * rule.num_up;
  const double most_turns = 2.0 * std::min(1.0, ratio) / (1.0 + ratio);
  for (int i = 0; i < rule.max_reversals.value_or(rule.max_trials); ++i) {
    const double step = rule.step_sizes[std::min<std::size_t>(i, rule.step_sizes.size() - 1)];
    const double turns =
        2.0 * ratio / ((1.0 + ratio) * (1.0 + ratio)) + rise * step * ratio / (1.0 + ratio);
    num_trials += verdict_trials / std::min(turns, most_turns);
  }
  return std::min(num_trials, static_cast<double>(rule.max_trials));
}

}  // namespace jnd::experiments
