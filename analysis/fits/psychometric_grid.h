#pragma once

#include <vector>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Curves from nearly flat to a step between neighbouring levels, from which least squares and
/// free lapses, whose cost can have several minima, are searched. Computed once over one set of
/// levels, for as many sets of answers as wanted. More than 512 levels are looked at in as many
/// groups of neighbours.
class PsychometricGrid {
 public:
  /// `every_level` is read for its intensities only; they must identify the free parameters.
  PsychometricGrid(const PsychometricLevels& every_level, bool free_pse);

  /// The grid's local minima for these answers, best first, each with its best lapse; steps
  /// are left out, because their cost is known. `every_level` has the intensities of the
  /// constructor's.
  [[nodiscard]] std::vector<PsychometricCurve> minima(const PsychometricLevels& every_level,
                                                      PsychometricMethod method,
                                                      bool free_lapse) const;

 private:
  struct Point {
    double slope, place;  ///< z = slope (abscissa - place)
    bool is_step;         ///< At most one level is where the curve rises.
  };

  void add(const PsychometricLevels& levels, bool free_pse, double slope, double place);
  /// Whether a point costs less than its neighbours along place and slope.
  [[nodiscard]] bool is_lowest_around(std::size_t slope, std::size_t point,
                                      const std::vector<double>& cost) const;

  std::vector<Point> points_;             ///< By slope, then by place.
  std::vector<std::size_t> slope_begin_;  ///< Of each slope in the points, then their end.
  std::vector<double> lower_tail_;        ///< F(z) at each point and level, levels fastest.
};

}  // namespace jnd::analysis
