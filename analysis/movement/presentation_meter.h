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

/// What adds up over presentations of the same kind.
struct MovementSums {
  StrokeSums strokes;
  StrokeCurveSums curves;
  ForceSums force;
  double height_m = 0.0;
  std::int64_t num_ticks = 0;  ///< That `height_m` was added up over.

  void add(const MovementSums& other);
  [[nodiscard]] std::optional<double> mean_height_m() const noexcept {
    if (num_ticks == 0) return std::nullopt;
    return height_m / static_cast<double>(num_ticks);
  }
};

/// The samples of one session's presentations, one presentation after the other. A stretch
/// between gaps stands for itself: no stroke reaches across one. Not real time.
class PresentationMeter {
 public:
  struct Parameters {
    HalfStrokeFinder::Parameters strokes;
    std::array<double, 2> forward = {1.0, 0.0};  ///< Unit vector, x and y.
    std::int64_t ramp_ticks = 0;                 ///< Left out at the beginning, >= 0.
    bool has_joints = false;
  };

  explicit PresentationMeter(const Parameters& parameters);

  /// The identity of `presentation` is kept, its movement is to be found out.
  void begin(const PresentationMovement& presentation, const CommandedForce& commanded);
  /// In the order of their ticks, within the presentation. One that is not finite counts as
  /// missing, one that was there already is left out. Whether it was taken.
  bool feed(const core::Sample& sample);
  /// What the last sample was reduced to.
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
  std::uint8_t held_bits_ = 0;  ///< Points that held when a presentation began.

  Result result_;
  CommandedForce commanded_;
  HandTick hand_;
  std::int64_t last_tick_ = 0;
  bool first_sample_ = true;
  // Of the stretch under way: halves that followed one another without a flaw, the newest last;
  // the first half of a stroke; the stroke that closes best, in case that nothing better comes.
  struct Alone {
    HalfStroke first, second;
    double open_ratio = 0.0;
  };
  std::array<std::optional<HalfStroke>, 2> before_;
  std::optional<HalfStroke> there_;
  std::optional<Alone> alone_;
  bool has_continuous_ = false;
};

/// The hand of a sample: mean of the points that the device has, as `StrokeMeter` is fed.
[[nodiscard]] HandTick hand_tick(const core::Sample& sample,
                                 const std::array<double, 2>& forward) noexcept;

}  // namespace jnd::analysis
