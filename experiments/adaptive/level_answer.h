#pragma once

namespace jnd::experiments {

/// One trial of an adaptive procedure: the level that was presented and the answer. They are
/// one value, so that a list of levels cannot be shifted against a list of answers.
struct LevelAnswer {
  /// The presented level in the unit of the quantity. It counts even if the procedure had
  /// proposed another one.
  double level = 0.0;
  bool yes = false;

  bool operator==(const LevelAnswer&) const = default;
};

}  // namespace jnd::experiments
