#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/movement/recorded_strokes.h"
#include "analysis/movement/stroke_curves.h"
#include "core/sample.h"

namespace jnd::analysis {

/// The last ticks of a presentation, as far as strokes over them are still to be normalised.
/// Holds at most `capacity` ticks and forgets the oldest.
class StrokeBuffer {
 public:
  // Forward velocity, height, opposing force, distances of the tips; then the joints' angles
  // and torques.
  static constexpr std::size_t kNumHandChannels = 3 + core::kNumContactPoints;
  static constexpr std::size_t kNumJointChannels = std::size_t{2} * core::kNumJoints;
  static constexpr std::size_t kNumChannels = kNumHandChannels + kNumJointChannels;

  StrokeBuffer(std::size_t capacity, bool has_joints);

  /// `hand` is what the sample was reduced to. A tick that does not follow the last one starts
  /// the buffer anew.
  void push(const HandTick& hand, const core::Sample& sample);
  void restart() noexcept { size_ = 0; }

  [[nodiscard]] bool has_joints() const noexcept { return has_joints_; }
  [[nodiscard]] bool holds(std::int64_t tick) const noexcept {
    return size_ > 0 && tick <= last_tick_ && tick > last_tick_ - size_;
  }
  /// Walks from the first tick to the last one, forward or backward in time, until the hand
  /// passes the middle between a half stroke's turning points: that time in ticks. Nothing if
  /// it does not, or if not all of the way is held.
  [[nodiscard]] std::optional<double> passes_middle(const HalfStroke& half,
                                                    std::int64_t first_tick,
                                                    std::int64_t last_tick) const;
  /// Every channel at a time between two ticks, on the line between them; those of the joints
  /// only if there are any. The ticks around it must be held.
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
  // Rings, by tick modulo capacity.
  std::vector<Place> places_;
  std::vector<std::array<double, kNumHandChannels>> hand_;
  std::vector<std::array<float, kNumJointChannels>>
      joints_;  ///< Angles and torques of the joints, in the precision of samples.
  std::int64_t last_tick_ = -1, size_ = 0;
};

/// Mean and spread of channels over strokes, a point of the stroke each.
class BandSums {
 public:
  /// One value a channel and point, in the same order every time.
  void add(const std::vector<double>& values);
  void add(const BandSums& other);
  [[nodiscard]] int num_strokes() const noexcept { return num_strokes_; }
  /// The band of `num_points` values from the place `first` on.
  [[nodiscard]] CurveBand band(std::size_t first, std::size_t num_points) const;

 private:
  int num_strokes_ = 0;
  std::vector<double> mean_, squares_;  ///< Squared deviations from the mean, added up.
};

/// Lays strokes over one another: from the time at which the hand, on its way back, passes the
/// middle of the motion forward that follows (0 %) to the time at which it does so again
/// (100 %), linear in time, 101 points.
class StrokeCurveSums {
 public:
  /// Halves that follow one another: back, forward, back. Whether both ways back pass the
  /// middle of the one forward, and every value is finite: else nothing is added.
  bool add_continuous(const StrokeBuffer& buffer, const HalfStroke& back_before,
                      const HalfStroke& forward, const HalfStroke& back);
  /// A stroke alone, whose end is joined to its beginning: for presentations of one stroke.
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
