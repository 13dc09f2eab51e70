#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Which of slope, offset and lapse the search may move. A fixed pse is offset 0, because the
/// log ratios are then those to the reference.
using FreeParameters = std::array<bool, 3>;

/// A stationary point of the cost.
struct PsychometricOptimum {
  PsychometricCurve curve;
  PsychometricCost cost;
  bool converged = false;
};

/// Newton's method with the exact Hessian, made positive definite where it is not, a step that
/// keeps the slope > 0 and the lapse in [0, 0.5), and backtracking. Quadratic convergence: at
/// `converged` the parameters are right to about 1e-14. Goes downhill from `start`.
[[nodiscard]] PsychometricOptimum minimised(const PsychometricLevels& levels,
                                            PsychometricMethod method,
                                            const FreeParameters& free,
                                            const PsychometricCurve& start) noexcept;

/// Where the supremum lies.
enum class PsychometricSupremum {
  kAttained,      ///< At one curve.
  kStep,          ///< At infinite slope: w falls to 0.
  kFlat,          ///< At slope 0: w grows without bound.
  kUnidentified,  ///< At many curves alike, or for want of data nowhere in particular.
  kImpossible,    ///< No curve gives these answers: a yes at intensity 0 without lapses.
  kNotConverged,
};

struct PsychometricSearchResult {
  PsychometricSupremum supremum = PsychometricSupremum::kNotConverged;
  std::string_view reason;  ///< A sentence for people, static; "" if attained.
  PsychometricOptimum optimum;
};

/// Finds the global optimum over one set of levels, for as many sets of answers as wanted: the
/// grid that least squares and free lapses start from is computed once.
///
/// Maximum likelihood without lapses is concave, and whether its optimum exists is decided
/// exactly from the counts (Albert and Anderson 1984). Otherwise the best stationary point is
/// compared with the infimum at infinite slope and at slope 0, both known in closed form; a
/// difference below 1e-13 of the cost counts as none.
class PsychometricSearch {
 public:
  /// `levels` is read for its intensities and trials only.
  PsychometricSearch(const PsychometricLevels& levels, PsychometricMethod method, bool free_pse,
                     bool free_lapse);

  /// `levels` as in the constructor, with answers of its own. `near` is a curve to start from.
  [[nodiscard]] PsychometricSearchResult find(const PsychometricLevels& levels,
                                              const PsychometricCurve* near = nullptr) const;

  [[nodiscard]] const FreeParameters& free() const noexcept { return free_; }

 private:
  struct GridPoint {
    double slope, place;  ///< z = slope (log_ratio - place)
  };

  void build_grid(const PsychometricLevels& levels);
  /// Whether a grid point costs less than its neighbours along place and slope.
  [[nodiscard]] bool is_lowest_around(std::size_t slope, std::size_t point,
                                      const std::vector<double>& cost) const;
  /// The grid's local minima, best first, each with its best lapse.
  [[nodiscard]] std::vector<PsychometricCurve> starts(const PsychometricLevels& levels) const;
  [[nodiscard]] PsychometricSearchResult grid_optimum(const PsychometricLevels& levels,
                                                      const PsychometricCurve* near) const;

  PsychometricMethod method_;
  bool free_pse_, free_lapse_;
  FreeParameters free_;
  std::vector<GridPoint> grid_;           ///< By slope, then by place.
  std::vector<std::size_t> slope_begin_;  ///< Of each slope in the grid, then the grid's end.
  std::vector<double> lower_tail_;  ///< Phi(z) at each grid point and level, levels fastest.
};

}  // namespace jnd::analysis
