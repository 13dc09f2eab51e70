#pragma once

namespace jnd::experiments {

/// One trial of an adaptive procedure: what was presented, and what was answered to it. They
/// are one value, so that no list of levels can be shifted against a list of answers.
struct LevelAnswer {
  /// The level that was presented, unit of the quantity; it counts even where the procedure had
  /// proposed another one.
  double level = 0.0;
  bool yes = false;

  bool operator==(const LevelAnswer&) const = default;
};

}  // namespace jnd::experiments
