#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "analysis/results/predictive.h"
#include "analysis/results/predictive_people.h"
#include "analysis/results/published.h"
#include "analysis/results/published_statistics.h"

namespace jnd::analysis {

/// Draws studies from simulated people and holds published values against them. A draw takes
/// its people from one group, nobody twice, evenly over the cells of the counterbalancing; a
/// statistic that rests on fewer participants than the published study had takes the first of
/// them. Not real time; one thread a time.
class PredictiveStudies {
 public:
  /// `people` must outlive it. `num_participants` of each study: at least one, and no more than
  /// a group has; throws `core::Error` otherwise.
  PredictiveStudies(const PredictivePeople& people, int num_participants, int num_studies);
  PredictiveStudies(const PredictiveStudies&) = delete;
  PredictiveStudies& operator=(const PredictiveStudies&) = delete;

  [[nodiscard]] int num_studies() const noexcept { return static_cast<int>(drawn_.size()); }

  /// Nothing for a value without a number or a statistic, or that fewer than half the studies
  /// have.
  [[nodiscard]] std::optional<PredictiveTail> tail_of(const PublishedValue& published) const;

  /// How far out all of these lie together: Mahalanobis' distance of their normal scores (the
  /// published study ranked among the simulated ones), whose correlations those of the studies
  /// are. Values without a statistic, and those that follow from others, are left out; nothing
  /// without any.
  [[nodiscard]] std::optional<JointTail> joint_tail(
      const std::vector<PublishedValue>& published) const;

 private:
  struct Draw {
    std::size_t group = 0;
    std::vector<std::size_t> places;  ///< In `everybody_`.
  };
  using Values = std::vector<std::optional<double>>;  ///< One a study.

  /// Computed once of each statistic and number of participants.
  [[nodiscard]] const Values& values_of(const PublishedValue& published) const;
  /// Of the mean over all studies of what is 0 or 1 in each.
  [[nodiscard]] double standard_error(const std::vector<bool>& counted) const;

  std::vector<PersonOutcome> everybody_;
  std::vector<Draw> drawn_;
  std::size_t num_groups_ = 0;
  struct Known {
    PublishedStatistic statistic;
    std::size_t num_participants = 0;
    Values values;
  };
  mutable PublishedStatistics statistics_{everybody_};
  mutable std::deque<Known> known_;
};

}  // namespace jnd::analysis
