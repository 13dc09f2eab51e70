#pragma once

#include <optional>
#include <string>
#include <vector>

namespace jnd::analysis {

/// A published value compared with the values of simulated studies of the same size, by the
/// statistic that was published. The comparison includes both the sampling error of the
/// simulated people and that of the published ones, because it treats the published study as
/// one more simulated one.
struct PredictiveTail {
  /// The values of all simulated studies that have one. A value is infinite if somebody's own
  /// is.
  std::vector<double> values;
  /// The median of these values, and the middle 95 %.
  double median = 0.0, low = 0.0, high = 0.0;
  /// The share of studies whose value is at least as far on this side, with values rounded as
  /// the publication rounds. It is the smaller of the shares of both sides.
  double tail = 0.0;
  bool is_below = false;  ///< Whether the published value lies below the middle.
  /// The standard error of the tail, from the differences between the groups of people.
  double standard_error = 0.0;
  double p_value = 0.0;  ///< Two-sided: twice the tail, at most 1.
};

/// The joint comparison of several published values.
struct JointTail {
  int num_statistics = 0;
  double p_value = 0.0;  ///< The share of studies that are at least as far out.
  double standard_error = 0.0;
};

/// The comparison of a published study with simulated studies.
struct Predictive {
  /// The number of people from whom studies were drawn; 0 without any.
  int num_people = 0;
  int num_studies = 0;  ///< The number of studies that were drawn.
  /// The number of participants of each study, as in the published study.
  int num_participants = 0;
  std::string reason;  ///< Why there are no studies; "" if there are some.
  /// The first is over all statistics except those that follow from others. The second is over
  /// those to which the laboratory was not fitted and which it does not imply.
  std::optional<JointTail> joint, joint_held_out;
};

}  // namespace jnd::analysis
