#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "analysis/movement/force_by_speed.h"
#include "analysis/movement/normalised_stroke.h"
#include "analysis/movement/presentation_movement.h"
#include "analysis/movement/recorded_strokes.h"
#include "core/sample.h"

namespace jnd::analysis {

/// Sums over presentations of the same kind.
struct MovementSums {
  StrokeSums strokes;
  StrokeCurveSums curves;
  ForceSums force;
  double height_m = 0.0;
  std::int64_t num_ticks = 0;  ///< The number of ticks over which `height_m` was added up.

  void add(const MovementSums& other);
  [[nodiscard]] std::optional<double> mean_height_m() const noexcept {
    if (num_ticks == 0) return std::nullopt;
    return height_m / static_cast<double>(num_ticks);
  }
};

/// Measures the presentations of one session, one after the other, from their samples. Each
/// stretch without a gap is independent, so no stroke crosses a gap. Not real time.
class PresentationMeter {
 public:
  struct Parameters {
    HalfStrokeFinder::Parameters strokes;
    std::array<double, 2> forward = {1.0, 0.0};  ///< A unit vector, x and y.
    /// The number of ticks left out at the beginning, >= 0.
    std::int64_t ramp_ticks = 0;
    bool has_joints = false;
  };

  explicit PresentationMeter(const Parameters& parameters);

  /// Starts a presentation. The identity of `presentation` is kept, and its movement is
  /// determined.
  void begin(const PresentationMovement& presentation, const CommandedForce& commanded);
  /// Samples come in the order of their ticks, within the presentation. A sample that is not
  /// finite counts as missing, and a repeated one is left out. Returns whether the sample was
  /// used.
  bool feed(const core::Sample& sample);
  /// The last sample after reduction.
  [[nodiscard]] const HandTick& hand() const noexcept { return hand_; }

  struct Result {
    PresentationMovement movement;
    MovementSums sums;
  };
  [[nodiscard]] Result finish();

 private:
  void mark(const core::Sample& sample) noexcept;
  void take_half(const HalfStroke& half);
  void lay_over(const HalfStroke& half);
  void end_stretch();
  [[nodiscard]] bool goes_forward(const HalfStroke& half) const noexcept;

  Parameters parameters_;
  HalfStrokeFinder finder_;
  StrokeBuffer buffer_;
  std::uint8_t held_bits_ = 0;  ///< The points that held the hand when a presentation began.

  Result result_;
  CommandedForce commanded_;
  HandTick hand_;
  std::int64_t last_tick_ = 0;
  bool first_sample_ = true;
  // The state of the present stretch: successive halves without a flaw, with the newest last;
  // the first half of a stroke; and the stroke that closes best, in case nothing better comes.
  struct Alone {
    HalfStroke first, second;
    double open_ratio = 0.0;
  };
  std::array<std::optional<HalfStroke>, 2> before_;
  std::optional<HalfStroke> there_;
  std::optional<Alone> alone_;
  bool has_continuous_ = false;
};

/// The hand of a sample, which is the mean of the device's points, as `StrokeMeter` receives
/// it.
[[nodiscard]] HandTick hand_tick(const core::Sample& sample,
                                 const std::array<double, 2>& forward) noexcept;

}  // namespace jnd::analysis
