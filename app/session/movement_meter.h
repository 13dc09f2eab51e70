#pragma once

#include <optional>

#include "analysis/movement/finger_lag.h"
#include "analysis/movement/strokes.h"
#include "core/contact_sums.h"
#include "core/sample.h"
#include "core/storage/study_rows.h"

namespace jnd::app {

/// Measures the hand's movement during a presentation from its samples, as they come.
/// Everything that is stored about movement with a presentation is measured here. Used by one
/// thread at a time; no heap.
class MovementMeter {
 public:
  /// Begins again.
  void start() noexcept;
  /// `period_s` is the period of the loop.
  void feed(const core::Sample& sample, double period_s) noexcept;
  /// The whole strokes since the start.
  [[nodiscard]] int num_strokes() const noexcept { return strokes_.num_strokes(); }
  /// How the hand moved since the start. It does not contain what else the loop knows: forces
  /// and ticks.
  [[nodiscard]] core::PresentationMeasures finish() noexcept;
  /// The force that was delivered since the start (`core::delivered_force_n`), and how fast the
  /// hand was meanwhile.
  [[nodiscard]] const core::ContactSums& sums() const noexcept { return sums_; }

 private:
  void feed_lag(const core::Sample& sample) noexcept;

  analysis::StrokeMeter strokes_{analysis::StrokeMeter::Parameters{}};
  analysis::FingerLag lag_;
  core::ContactSums sums_;
};

}  // namespace jnd::app
