#pragma once

#include <string>
#include <vector>

#include "analysis/report/figures.h"

namespace jnd::analysis {

/// A medium that was explored outside of trials, as recordings show it.
struct ExploredMedium {
  struct Person {
    std::string participant;
    StrokeMeans strokes;
  };
  std::string title;  ///< For example "free space" or "viscous, 5 Pa s".
  std::vector<Person> people;
};

/// The explored media, in the order in which the analysis of the first participant has them.
[[nodiscard]] std::vector<ExploredMedium> explored_media(const FigureSource& source,
                                                         const MovementAnalysis& movement);

/// Everybody's stroke width and highest speed by medium. It is meant only for a study that
/// presents nothing in trials; other figures show the rest.
[[nodiscard]] std::vector<Figure> explored_figures(const FigureSource& source,
                                                   const MovementAnalysis& movement);

}  // namespace jnd::analysis
