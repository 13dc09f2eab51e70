#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "analysis/results/predictive.h"
#include "analysis/results/predictive_people.h"
#include "analysis/results/published.h"
#include "analysis/results/published_statistics.h"

namespace jnd::analysis {

/// Draws studies from simulated people and compares published values with them. A draw takes
/// its people from one group, nobody twice, evenly over the cells of the counterbalancing. A
/// statistic that rests on fewer participants than the published study had uses the first of
/// them. Not real time. Only one thread may use it at a time.
class PredictiveStudies {
 public:
  /// `people` must outlive the object. `num_participants` is the size of each study: at least
  /// one, and at most the size of a group. Throws `core::Error` otherwise.
  PredictiveStudies(const PredictivePeople& people, int num_participants, int num_studies);
  PredictiveStudies(const PredictiveStudies&) = delete;
  PredictiveStudies& operator=(const PredictiveStudies&) = delete;

  [[nodiscard]] int num_studies() const noexcept { return static_cast<int>(drawn_.size()); }

  /// Absent for a value without a number or a statistic, and if fewer than half the studies
  /// have the statistic.
  [[nodiscard]] std::optional<PredictiveTail> tail_of(const PublishedValue& published) const;

  /// How far out all of these values lie together: the Mahalanobis distance of their normal
  /// scores, with the correlations between studies. The published study is ranked among the
  /// simulated ones. Values without a statistic, and values that follow from others, are left
  /// out. The result is absent if none is left.
  [[nodiscard]] std::optional<JointTail> joint_tail(
      const std::vector<PublishedValue>& published) const;

 private:
  struct Draw {
    std::size_t group = 0;
    std::vector<std::size_t> places;  ///< Indices into `everybody_`.
  };
  using Values = std::vector<std::optional<double>>;  ///< One value for each study.

  /// Each combination of statistic and number of participants is computed once.
  [[nodiscard]] const Values& values_of(const PublishedValue& published) const;
  /// The standard error of the mean over all studies of a variable that is 0 or 1 in each.
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
