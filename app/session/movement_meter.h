#pragma once

#include <optional>

#include "analysis/movement/finger_lag.h"
#include "analysis/movement/strokes.h"
#include "core/contact_sums.h"
#include "core/sample.h"
#include "core/storage/study_rows.h"

namespace jnd::app {

/// What the samples of a presentation say of it while they come: the place for whatever is
/// measured of the hand's movement and stored with a presentation. Used by one thread at a
/// time; no heap.
class MovementMeter {
 public:
  /// Starts anew.
  void start() noexcept;
  /// `period_s`: of the loop.
  void feed(const core::Sample& sample, double period_s) noexcept;
  /// Whole strokes since the start.
  [[nodiscard]] int num_strokes() const noexcept { return strokes_.num_strokes(); }
  /// How the hand moved since the start. What the loop knows besides, forces and ticks, is not
  /// in it.
  [[nodiscard]] core::PresentationMeasures finish() noexcept;
  /// What was delivered since the start (`core::delivered_force_n`), and how fast the hand was
  /// meanwhile.
  [[nodiscard]] const core::ContactSums& sums() const noexcept { return sums_; }

 private:
  void feed_lag(const core::Sample& sample) noexcept;

  analysis::StrokeMeter strokes_{analysis::StrokeMeter::Parameters{}};
  analysis::FingerLag lag_;
  core::ContactSums sums_;
};

}  // namespace jnd::app
