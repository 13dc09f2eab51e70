#pragma once

#include <vector>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// How far apart a grid's curves are: slopes by a ratio from the flattest on, places by z.
struct GridSpacing {
  double flattest = 0.002, ratio = 1.2, place_z = 0.7;
};
/// For starts near which the optimum is, as of answers drawn anew.
inline constexpr GridSpacing kWideSpacing = {.flattest = 0.3, .ratio = 1.8, .place_z = 1.6};

/// Curves from nearly flat to a step between neighbouring levels, from which least squares and
/// free lapses, whose cost can have several minima, are searched. Computed once over one set of
/// levels, for as many sets of answers as wanted. More than 512 levels are looked at in as many
/// groups of neighbours.
class PsychometricGrid {
 public:
  /// `every_level` is read for its intensities only; they must identify the free parameters.
  PsychometricGrid(const PsychometricLevels& every_level, bool free_pse,
                   const GridSpacing& spacing = {});

  /// The grid's local minima for these answers, best first, each with its best lapse; steps
  /// are left out, because their cost is known. `every_level` has the intensities of the
  /// constructor's.
  [[nodiscard]] std::vector<PsychometricCurve> minima(const PsychometricLevels& every_level,
                                                      PsychometricMethod method,
                                                      bool free_lapse) const;

  /// ln f and ln (1 - f) at each point and level, between ends that are held.
  [[nodiscard]] std::vector<double> log_likelihoods(const PsychometricLevels& every_level,
                                                    double lapse, double guess) const;
  /// The lowest minima of the likelihood between these ends, at most so many: `logs` are those
  /// of `log_likelihoods`. Some microseconds.
  [[nodiscard]] std::vector<PsychometricCurve> minima(const PsychometricLevels& every_level,
                                                      const std::vector<double>& logs,
                                                      double lapse, double guess,
                                                      std::size_t most) const;

 private:
  struct Point {
    double slope, place;  ///< z = slope (abscissa - place)
    bool is_step;         ///< At most one level is where the curve rises.
  };

  void add(const PsychometricLevels& levels, bool free_pse, double slope, double place);
  /// Whether a point costs less than its neighbours along place and slope.
  [[nodiscard]] bool is_lowest_around(std::size_t slope, std::size_t point,
                                      const std::vector<double>& cost) const;

  /// Points that are the lowest around, lowest first.
  [[nodiscard]] std::vector<std::size_t> lowest_points(const std::vector<double>& cost,
                                                       std::size_t most) const;

  std::vector<Point> points_;             ///< By slope, then by place.
  std::vector<std::size_t> slope_begin_;  ///< Of each slope in the points, then their end.
  std::vector<double> lower_tail_;        ///< F(z) at each point and level, levels fastest.
};

}  // namespace jnd::analysis
