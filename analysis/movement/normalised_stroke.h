#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/movement/recorded_strokes.h"
#include "analysis/movement/stroke_curves.h"
#include "core/sample.h"

namespace jnd::analysis {

/// The last ticks of a presentation, as long as strokes over them may still be normalised. It
/// holds at most `capacity` ticks and forgets the oldest.
class StrokeBuffer {
 public:
  // The channels are forward velocity, height, opposing force and the distances of the tips,
  // and then the angles and torques of the joints.
  static constexpr std::size_t kNumHandChannels = 3 + core::kNumContactPoints;
  static constexpr std::size_t kNumJointChannels = std::size_t{2} * core::kNumJoints;
  static constexpr std::size_t kNumChannels = kNumHandChannels + kNumJointChannels;

  StrokeBuffer(std::size_t capacity, bool has_joints);

  /// `hand` is the reduced sample. A tick that does not follow the last one restarts the
  /// buffer.
  void push(const HandTick& hand, const core::Sample& sample);
  void restart() noexcept { size_ = 0; }

  [[nodiscard]] bool has_joints() const noexcept { return has_joints_; }
  [[nodiscard]] bool holds(std::int64_t tick) const noexcept {
    return size_ > 0 && tick <= last_tick_ && tick > last_tick_ - size_;
  }
  /// Walks from the first tick to the last, forward or backward in time, until the hand passes
  /// the middle between a half stroke's turning points, and returns that time in ticks. It is
  /// absent if the hand does not pass the middle, or if the buffer does not hold the whole way.
  [[nodiscard]] std::optional<double> passes_middle(const HalfStroke& half,
                                                    std::int64_t first_tick,
                                                    std::int64_t last_tick) const;
  /// The value of every channel at a time between two ticks, by linear interpolation. The
  /// joints' channels are filled in only if there are any. The buffer must hold the ticks
  /// around the time.
  void values_at(double tick, std::array<double, kNumChannels>& values) const;

 private:
  struct Place {
    double x_m, y_m;
  };
  [[nodiscard]] std::size_t slot(std::int64_t tick) const noexcept {
    return static_cast<std::size_t>(tick) % capacity_;
  }

  std::size_t capacity_;
  bool has_joints_;
  // Ring buffers, indexed by tick modulo capacity.
  std::vector<Place> places_;
  std::vector<std::array<double, kNumHandChannels>> hand_;
  std::vector<std::array<float, kNumJointChannels>>
      joints_;  ///< Angles and torques of the joints, in the precision of samples.
  std::int64_t last_tick_ = -1, size_ = 0;
};

/// The mean and spread of channels over strokes, at each point of the stroke.
class BandSums {
 public:
  /// Adds one value for each channel and point, always in the same order.
  void add(const std::vector<double>& values);
  void add(const BandSums& other);
  [[nodiscard]] int num_strokes() const noexcept { return num_strokes_; }
  /// The band of `num_points` values, starting at the index `first`.
  [[nodiscard]] CurveBand band(std::size_t first, std::size_t num_points) const;

 private:
  int num_strokes_ = 0;
  /// The means, and the sums of squared deviations from them.
  std::vector<double> mean_, squares_;
};

/// Superimposes strokes. A stroke starts (0 %) when the hand, on its way back, passes the
/// middle of the following forward motion, and ends (100 %) when it does so again. It has 101
/// points, linear in time.
class StrokeCurveSums {
 public:
  /// Adds the stroke over three successive halves: back, forward, back. Returns whether both
  /// ways back pass the middle of the forward one and every value is finite. Otherwise it adds
  /// nothing.
  bool add_continuous(const StrokeBuffer& buffer, const HalfStroke& back_before,
                      const HalfStroke& forward, const HalfStroke& back);
  /// Adds a single stroke and joins its end to its beginning. It is meant for presentations
  /// with only one stroke.
  void add_joined(const StrokeBuffer& buffer, const HalfStroke& first, const HalfStroke& second,
                  bool first_is_back);
  void add(const StrokeCurveSums& other);
  [[nodiscard]] StrokeCurves curves() const;

 private:
  bool add(const StrokeBuffer& buffer, double first_tick, double last_tick,
           std::optional<std::int64_t> seam_tick, std::int64_t joined_tick);

  BandSums hand_, joints_, turns_;
  int num_joined_ = 0;
};

}  // namespace jnd::analysis
