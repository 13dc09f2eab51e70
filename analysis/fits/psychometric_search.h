#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/fits/psychometric_descent.h"
#include "analysis/fits/psychometric_existence.h"
#include "analysis/fits/psychometric_grid.h"

namespace jnd::analysis {

struct PsychometricSearchResult {
  PsychometricSupremum supremum = PsychometricSupremum::kNotConverged;
  std::string_view reason;  ///< See `PsychometricExistence`.
  PsychometricOptimum optimum;
};

/// Finds the global optimum over one set of levels, for as many sets of answers as wanted: the
/// grid that least squares, lapses and guesses start from is computed once.
///
/// Maximum likelihood without lapses and guesses is concave, and whether its optimum exists is
/// decided exactly from the counts. Otherwise the best stationary point is compared with the
/// infimum at infinite slope and at slope 0, both known in closed form; a difference below
/// 1e-13 of the cost counts as none.
class PsychometricSearch {
 public:
  /// `levels` is read for its intensities, trials and ends only.
  PsychometricSearch(const PsychometricLevels& levels, PsychometricMethod method, bool free_pse,
                     bool free_lapse);

  /// `levels` as in the constructor, with answers of its own. From several starts Newton's
  /// method first sees how low each leads; `descent` then goes from the most promising.
  /// `near` is one more curve to start from.
  [[nodiscard]] PsychometricSearchResult find(const PsychometricLevels& levels,
                                              PsychometricDescent descent,
                                              const PsychometricCurve* near = nullptr) const;

  /// By Newton's method from these curves alone, one or more: for answers drawn anew, whose
  /// optimum is near one of them.
  [[nodiscard]] PsychometricSearchResult find_from(
      const PsychometricLevels& levels, const std::vector<PsychometricCurve>& starts) const;

  /// Whether there can be several minima, so that a search needs several starts.
  [[nodiscard]] bool needs_starts() const noexcept { return grid_.has_value(); }
  [[nodiscard]] PsychometricMethod method() const noexcept { return method_; }

  [[nodiscard]] const FreeParameters& free() const noexcept { return free_; }

 private:
  [[nodiscard]] PsychometricSearchResult found(
      const PsychometricLevels& levels, PsychometricDescent descent,
      const PsychometricCurve* near,
      const std::function<std::vector<PsychometricCurve>()>& starts) const;
  [[nodiscard]] PsychometricOptimum lowest_minimum(
      const PsychometricLevels& levels, PsychometricDescent descent,
      const std::vector<PsychometricCurve>& starts) const;

  PsychometricMethod method_;
  bool free_pse_, free_lapse_;
  FreeParameters free_;
  std::optional<PsychometricGrid> grid_;  ///< Absent where one start will do.
};

}  // namespace jnd::analysis
