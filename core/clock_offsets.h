#pragma once

#include <cstddef>
#include <vector>

namespace jnd::core {

/// One comparison of another clock with ours.
struct ClockOffset {
  double time_s = 0.0;    ///< Time of the comparison, by the other clock.
  double offset_s = 0.0;  ///< Add it to a time of the other clock to get ours.
  /// Duration of question and answer. The offset errs by half of it at most.
  double round_trip_s = 0.0;

  friend bool operator==(const ClockOffset&, const ClockOffset&) = default;
};

/// Converts times of another clock to ours, by all comparisons of the two clocks. About each
/// comparison it fits a straight line through the comparisons within a minute of it. Their
/// weight is the inverse square of the round trip, because a short round trip errs little.
/// Between two comparisons it interpolates between their lines' values. A leap of more than 50
/// ms, for example after a program or a machine was restarted, begins a new series. Without any
/// comparison, times stay as they are. Not real time.
class ClockCorrection {
 public:
  /// The offsets may come in any order.
  explicit ClockCorrection(std::vector<ClockOffset> offsets);

  [[nodiscard]] double offset_s(double time_s) const noexcept;
  [[nodiscard]] double corrected_s(double time_s) const noexcept {
    return time_s + offset_s(time_s);
  }
  [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }

 private:
  struct Node {
    double time_s = 0.0, offset_s = 0.0;
    /// Slope of the line beyond the first and the last comparison of a series.
    double slope = 0.0;
    /// Series of comparisons without a leap to which this one belongs.
    std::size_t first = 0, end = 0;
  };
  std::vector<Node> nodes_;  ///< Sorted by time.
};

}  // namespace jnd::core
