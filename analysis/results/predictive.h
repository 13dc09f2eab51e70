#pragma once

#include <optional>
#include <string>
#include <vector>

namespace jnd::analysis {

/// A published value among what simulated studies of the same size come to, by the statistic
/// that was published. So both the chance of the simulated people and that of the published
/// ones are in it: the published study is taken for one more of these.
struct PredictiveTail {
  /// Of each simulated study that has such a value; infinite where somebody's own is.
  std::vector<double> values;
  double median = 0.0, low = 0.0, high = 0.0;  ///< Of these, with the middle 95 %.
  /// Share of the studies that come out as far on this side, rounded as it was published: the
  /// smaller of both sides.
  double tail = 0.0;
  bool is_below = false;        ///< The published value lies below the middle.
  double standard_error = 0.0;  ///< Of the tail: so far do the groups of people differ.
  double p_value = 0.0;         ///< Two-sided: twice the tail, at most 1.
};

/// Some published values as one.
struct JointTail {
  int num_statistics = 0;
  double p_value = 0.0;  ///< Share of the studies that are at least as far out.
  double standard_error = 0.0;
};

/// What simulated studies tell of everything that was published of one.
struct Predictive {
  int num_people = 0;        ///< That studies were drawn from; 0 without any.
  int num_studies = 0;       ///< Studies that were drawn.
  int num_participants = 0;  ///< Participants of each study, as many as were published.
  std::string reason;        ///< Why there are none; "" if there are some.
  /// Of all statistics but those that follow from others; of those that the laboratory was
  /// neither fitted to nor implies.
  std::optional<JointTail> joint, joint_held_out;
};

}  // namespace jnd::analysis
