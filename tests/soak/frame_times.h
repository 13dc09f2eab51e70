#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace jnd::soak {

/// Records how long frames took, early and late in a soak, as counts in classes that are 2 %
/// wide. It has the same size after a day as at its beginning, so that the soak does not grow
/// by what it measures.
class FrameTimes {
 public:
  /// Adds a frame. `passed_ratio` is the share of the soak that has passed. The first eighth is
  /// warm-up, the second eighth is "at first", and the last eighth is "at last".
  void add(double took_s, double passed_ratio) noexcept {
    ++num_;
    if (passed_ratio >= 0.125 && passed_ratio < 0.25) at_first_.add(took_s);
    if (passed_ratio >= 0.875) at_last_.add(took_s);
  }
  [[nodiscard]] std::size_t num() const noexcept { return num_; }
  /// Returns the median in seconds, or 0 without frames.
  [[nodiscard]] double at_first_s() const noexcept { return at_first_.median_s(); }
  [[nodiscard]] double at_last_s() const noexcept { return at_last_.median_s(); }
  /// Returns the number of frames in the smaller of both groups.
  [[nodiscard]] std::size_t num_compared() const noexcept {
    return std::min(at_first_.num, at_last_.num);
  }

 private:
  struct Classes {
    static constexpr double kShortest_s = 1e-6, kStep = 1.02;
    static constexpr std::size_t kCount = 700;  // The classes reach up to a second.

    void add(double took_s) noexcept {
      const double place = std::log(std::max(took_s, kShortest_s) / kShortest_s) / kLogStep;
      ++counts[std::min(static_cast<std::size_t>(place), kCount - 1)];
      ++num;
    }
    [[nodiscard]] double median_s() const noexcept {
      std::size_t below = 0;
      for (std::size_t i = 0; i < kCount; ++i) {
        below += counts[i];
        if (2 * below > num) {
          return kShortest_s * std::exp((static_cast<double>(i) + 0.5) * kLogStep);
        }
      }
      return 0.0;
    }

    static inline const double kLogStep = std::log(kStep);
    std::array<std::uint32_t, kCount> counts{};
    std::size_t num = 0;
  };

  Classes at_first_, at_last_;
  std::size_t num_ = 0;
};

}  // namespace jnd::soak
