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

/// In which order ascending and descending series follow each other.
enum class SeriesOrder {
  kAscendingFirst,   ///< Alternating.
  kDescendingFirst,  ///< Alternating.
  kDrawnFirst,       ///< Alternating; the first is drawn.
  kShuffled,         ///< As many of each, for an even number of them; in random order.
};

/// How the method of limits is run.
struct LimitsRule {
  std::vector<double> levels;              ///< Ascending, two or more, unit of the quantity.
  LevelScale scale = LevelScale::kLinear;  ///< The scale of midpoints and means.
  int num_series = 0;                      ///< >= 1; an even number balances the directions.
  SeriesOrder order = SeriesOrder::kDrawnFirst;
  /// A series starts at its end of the levels, or up to so many levels further in, drawn, >= 0
  /// and less than the number of levels minus one: so that answers cannot be counted out.
  int max_start_offset = 0;
  /// "Yes" is the answer to high levels, as when it is asked whether the test is felt.
  bool yes_is_above = true;
  /// Changed answers that end a series, >= 1, fewer than any has levels; usually 1 or 2.
  int num_changed_in_a_row = 1;
};

/// A series as it was drawn.
struct PlannedSeries {
  SeriesDirection direction = SeriesDirection::kAscending;
  std::size_t start = 0;  ///< Index into the levels.

  bool operator==(const PlannedSeries&) const = default;
};

enum class SeriesEnd {
  kRunning,
  kTransition,
  kChangedAtStart,  ///< The answers were the changed ones from the start on: no midpoint.
  kNeverChanged,    ///< Nor at the last level, or not often enough.
};

/// A series as far as it has been answered.
struct LimitsSeries {
  SeriesDirection direction = SeriesDirection::kAscending;
  SeriesEnd end = SeriesEnd::kRunning;
  int num_trials = 0;
  /// Midpoint of the last unchanged level and the first changed one, both as presented.
  std::optional<double> transition;
};

/// What the answers so far come to.
struct LimitsState {
  std::optional<double> next_level;  ///< Unit of the quantity; none when finished.
  std::vector<LimitsSeries> series;  ///< The series that were begun.
  /// Answers behind the end of their series, which decide nothing: a correction can put the end
  /// before them.
  int num_after_end = 0;

  [[nodiscard]] bool is_finished() const noexcept { return !next_level.has_value(); }
};

/// Means are taken in the scale of the rule; levels have the unit of the quantity.
struct LimitsThreshold {
  std::optional<double> level;       ///< Mean of all transitions.
  std::optional<double> ascending;   ///< Mean of those of ascending series.
  std::optional<double> descending;  ///< Mean of those of descending series.
  /// Constant error, ascending less descending, in the unit or in ln: above 0 people stay with
  /// the answer they gave (habituation), below 0 they change it early (anticipation).
  std::optional<double> constant_error;
  int num_ascending = 0;  ///< Transitions.
  int num_descending =
      0;  ///< Transitions. If the two differ, the constant error does not cancel.
};

/// The method of limits (Fechner 1860; Gescheider 1997, ch. 3): levels rise, or fall, until the
/// answer changes. Has no state of its own: an answer taken back is one that is not passed in.
/// Not real time.
class Limits {
 public:
  /// Throws `Error` naming the field of the rule that is wrong.
  explicit Limits(LimitsRule rule);

  [[nodiscard]] const LimitsRule& rule() const noexcept { return rule_; }
  /// All series, drawn beforehand: the same for the same stream.
  [[nodiscard]] std::vector<PlannedSeries> drawn_series(core::RandomStream& stream) const;
  /// All from the start; `plan` is what `drawn_series` gave. Throws `Error` if there is an
  /// answer after the last series, or a level that is none.
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
