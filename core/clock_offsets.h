#pragma once

#include <cstddef>
#include <vector>

namespace jnd::core {

/// One comparison of a clock elsewhere with ours.
struct ClockOffset {
  double time_s = 0.0;        ///< When, by the clock elsewhere.
  double offset_s = 0.0;      ///< To be added to its times, which makes them ours.
  double round_trip_s = 0.0;  ///< Twice the largest error that the offset can have.

  friend bool operator==(const ClockOffset&, const ClockOffset&) = default;
};

/// Times of a clock elsewhere as times of ours, by all comparisons of the two. About each
/// comparison a straight line is fitted through those within a minute of it, weighted by the
/// inverse square of the round trip, for a short way errs little; between two comparisons the
/// values of the lines are joined. A leap of more than 50 ms, as where a program or a machine
/// is started anew, begins afresh. Without a comparison times stay as they are. Not real time.
class ClockCorrection {
 public:
  /// In any order.
  explicit ClockCorrection(std::vector<ClockOffset> offsets);

  [[nodiscard]] double offset_s(double time_s) const noexcept;
  [[nodiscard]] double corrected_s(double time_s) const noexcept {
    return time_s + offset_s(time_s);
  }
  [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }

 private:
  struct Node {
    double time_s = 0.0, offset_s = 0.0;
    double slope = 0.0;              ///< Of the line, beyond the ends.
    std::size_t first = 0, end = 0;  ///< The comparisons without a leap that it is one of.
  };
  std::vector<Node> nodes_;  ///< By time.
};

}  // namespace jnd::core
