#pragma once

#include <vector>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// The spacing of a grid's curves. Slopes grow by `ratio` from the flattest one; places differ
/// by `place_z` in z.
struct GridSpacing {
  double flattest = 0.002, ratio = 1.2, place_z = 0.7;
};
/// The spacing for searches whose optimum is near known curves, such as fits of redrawn
/// answers.
inline constexpr GridSpacing kWideSpacing = {.flattest = 0.3, .ratio = 1.8, .place_z = 1.6};

/// A grid of curves from nearly flat to a step between neighbouring levels. Searches for least
/// squares and free lapses start from it, because their cost can have several minima. It is
/// computed once for a set of levels, and serves any number of sets of answers. If there are
/// more than 512 levels, neighbours are grouped into 512.
class PsychometricGrid {
 public:
  /// Only the intensities of `every_level` are read. They must identify the free parameters.
  PsychometricGrid(const PsychometricLevels& every_level, bool free_pse,
                   const GridSpacing& spacing = {});

  /// The grid's local minima for these answers, best first, each with its best lapse rate.
  /// Steps are left out, because their cost is known. `every_level` has the same intensities as
  /// in the constructor.
  [[nodiscard]] std::vector<PsychometricCurve> minima(const PsychometricLevels& every_level,
                                                      PsychometricMethod method,
                                                      bool free_lapse) const;

  /// ln f and ln (1 - f) at each point and level, for the given lapse and guess rates.
  [[nodiscard]] std::vector<double> log_likelihoods(const PsychometricLevels& every_level,
                                                    double lapse, double guess) const;
  /// At most `most` of the lowest minima of minus the log-likelihood for the given lapse and
  /// guess rates. `logs` is the result of `log_likelihoods` for the same rates. It takes some
  /// microseconds.
  [[nodiscard]] std::vector<PsychometricCurve> minima(const PsychometricLevels& every_level,
                                                      const std::vector<double>& logs,
                                                      double lapse, double guess,
                                                      std::size_t most) const;

 private:
  struct Point {
    double slope, place;  ///< z = slope (abscissa - place)
    bool is_step;         ///< At most one level lies where the curve rises.
  };

  void add(const PsychometricLevels& levels, bool free_pse, double slope, double place);
  /// Whether a point costs less than its neighbours along place and slope.
  [[nodiscard]] bool is_lowest_around(std::size_t slope, std::size_t point,
                                      const std::vector<double>& cost) const;

  /// The points that cost less than all their neighbours, lowest first.
  [[nodiscard]] std::vector<std::size_t> lowest_points(const std::vector<double>& cost,
                                                       std::size_t most) const;

  std::vector<Point> points_;  ///< Sorted by slope, then by place.
  /// The index of each slope's first point, and at last the number of points.
  std::vector<std::size_t> slope_begin_;
  /// F(z) at each point and level; the levels vary fastest.
  std::vector<double> lower_tail_;
};

}  // namespace jnd::analysis
