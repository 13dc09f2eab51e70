#pragma once

#include <string>
#include <vector>

#include "analysis/report/figures.h"

namespace jnd::analysis {

/// A medium explored outside of trials, as recordings show it.
struct ExploredMedium {
  struct Person {
    std::string participant;
    StrokeMeans strokes;
  };
  std::string title;  ///< "free space", "viscous, 5 Pa s".
  std::vector<Person> people;
};

/// In the order in which the first participant's analysis has them.
[[nodiscard]] std::vector<ExploredMedium> explored_media(const FigureSource& source,
                                                         const MovementAnalysis& movement);

/// Width and highest speed by medium, everybody's; only of a study that presents nothing in
/// trials, whose figures show the rest.
[[nodiscard]] std::vector<Figure> explored_figures(const FigureSource& source,
                                                   const MovementAnalysis& movement);

}  // namespace jnd::analysis
