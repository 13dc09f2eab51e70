#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/random_stream.h"
#include "experiments/adaptive/level_answer.h"
#include "experiments/adaptive/level_scale.h"

namespace jnd::experiments {

enum class SeriesDirection { kAscending, kDescending };

/// The order in which ascending and descending series follow one another.
enum class SeriesOrder {
  kAscendingFirst,   ///< They alternate.
  kDescendingFirst,  ///< They alternate.
  kDrawnFirst,       ///< They alternate, and the first direction is drawn.
  kShuffled,         ///< Equally many of each, if their number is even, in random order.
};

/// How the method of limits is run.
struct LimitsRule {
  /// Two or more, ascending, in the unit of the quantity.
  std::vector<double> levels;
  LevelScale scale = LevelScale::kLinear;  ///< Scale of midpoints and means.
  int num_series = 0;                      ///< >= 1; an even number balances the directions.
  SeriesOrder order = SeriesOrder::kDrawnFirst;
  /// A series starts at its end of the levels, or a drawn number of levels further in. This is
  /// the largest such number, >= 0 and below the number of levels minus one. It keeps
  /// participants from counting trials.
  int max_start_offset = 0;
  /// "Yes" is the answer to high levels, for example to the question whether the test is felt.
  bool yes_is_above = true;
  /// Number of changed answers that end a series, >= 1 and below the number of levels of the
  /// shortest series; usually 1 or 2.
  int num_changed_in_a_row = 1;
};

/// A series as it was drawn.
struct PlannedSeries {
  SeriesDirection direction = SeriesDirection::kAscending;
  std::size_t start = 0;  ///< Index of its first level.

  bool operator==(const PlannedSeries&) const = default;
};

enum class SeriesEnd {
  kRunning,
  kTransition,
  kChangedAtStart,  ///< The answers were changed ones from the start, so there is no midpoint.
  kNeverChanged,    ///< The answer did not change up to the last level, or not often enough.
};

/// A series as far as it has been answered.
struct LimitsSeries {
  SeriesDirection direction = SeriesDirection::kAscending;
  SeriesEnd end = SeriesEnd::kRunning;
  int num_trials = 0;
  /// Midpoint of the last unchanged level and the first changed one, both as presented.
  std::optional<double> transition;
};

/// The state of the method after the answers so far.
struct LimitsState {
  std::optional<double> next_level;  ///< Unit of the quantity; none when finished.
  std::vector<LimitsSeries> series;  ///< The series that were begun.
  /// Answers behind the end of their series, which decide nothing: a correction can put the end
  /// before them.
  int num_after_end = 0;

  [[nodiscard]] bool is_finished() const noexcept { return !next_level.has_value(); }
};

/// The threshold. Means are taken in the scale of the rule; levels have the unit of the
/// quantity.
struct LimitsThreshold {
  std::optional<double> level;       ///< Mean of all transitions.
  std::optional<double> ascending;   ///< Mean of the transitions of ascending series.
  std::optional<double> descending;  ///< Mean of the transitions of descending series.
  /// Constant error: the ascending mean minus the descending one, in the unit or in ln. Above 0
  /// people keep the answer they gave (habituation), below 0 they change it early
  /// (anticipation).
  std::optional<double> constant_error;
  int num_ascending = 0;   ///< Number of transitions.
  int num_descending = 0;  ///< Number of transitions. If the two numbers differ, the constant
                           ///< error does not cancel.
};

/// The method of limits (Fechner 1860; Gescheider 1997, ch. 3): levels rise, or fall, until the
/// answer changes. It has no state: to take an answer back, leave it out of the list. Not real
/// time.
class Limits {
 public:
  /// Throws `Error` naming the field of the rule that is wrong.
  explicit Limits(LimitsRule rule);

  [[nodiscard]] const LimitsRule& rule() const noexcept { return rule_; }
  /// Draws all series in advance. The same stream gives the same series.
  [[nodiscard]] std::vector<PlannedSeries> drawn_series(core::RandomStream& stream) const;
  /// Computes the state from the start. `plan` is the result of `drawn_series`. Throws `Error`
  /// for an answer after the last series, and for an invalid level.
  [[nodiscard]] LimitsState after(const std::vector<PlannedSeries>& plan,
                                  const std::vector<LevelAnswer>& answers) const;
  /// The same where each answer is known to be of its series. One that a correction has left
  /// without an end, while others came after it, has no transition.
  [[nodiscard]] LimitsState after_series(
      const std::vector<PlannedSeries>& plan,
      const std::vector<std::vector<LevelAnswer>>& answers) const;
  [[nodiscard]] LimitsThreshold threshold(const LimitsState& state) const;

 private:
  [[nodiscard]] double next_level(const PlannedSeries& planned,
                                  const LimitsSeries& series) const;
  [[nodiscard]] LimitsSeries series_of(const PlannedSeries& planned,
                                       std::span<const LevelAnswer> answers) const;
  [[nodiscard]] std::optional<double> mean_transition(
      const LimitsState& state, std::optional<SeriesDirection> direction) const;

  LimitsRule rule_;
};

}  // namespace jnd::experiments
