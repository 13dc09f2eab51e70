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

/// Finds the global optimum for any number of sets of answers over one set of levels. The grid
/// from which least squares, lapses and guesses start is computed once.
///
/// Maximum likelihood without lapses and guesses is concave, and the counts decide exactly
/// whether its optimum exists. Otherwise the best stationary point is compared with the infimum
/// at infinite slope and at slope 0, which are both known in closed form. A difference below
/// 1e-13 of the cost counts as none.
class PsychometricSearch {
 public:
  /// Only the intensities, trials and ends of `levels` are read.
  PsychometricSearch(const PsychometricLevels& levels, PsychometricMethod method, bool free_pse,
                     bool free_lapse);

  /// `levels` are those of the constructor, with other answers. If there are several starts,
  /// Newton's method first finds how low each one leads, and `descent` then runs from the most
  /// promising ones. `near` is one more curve to start from.
  [[nodiscard]] PsychometricSearchResult find(const PsychometricLevels& levels,
                                              PsychometricDescent descent,
                                              const PsychometricCurve* near = nullptr) const;

  /// Runs Newton's method from these curves only, of which there is at least one. It is meant
  /// for redrawn answers, whose optimum is near one of them.
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
  std::optional<PsychometricGrid> grid_;  ///< The grid is absent if one start suffices.
};

}  // namespace jnd::analysis
