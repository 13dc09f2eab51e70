#pragma once

#include <string>
#include <vector>

#include "app/gui/views/results_view.h"

namespace jnd::app::gui {

// The parts of the results view: its pages, and the table beside them.

enum class ResultsPage { kCharts, kBoxes, kComparisons, kNumbers };

struct ResultsPageLook {
  ResultsPage page;
  const char *name, *label;
};
/// Those that have anything to show.
[[nodiscard]] std::vector<ResultsPageLook> pages_of(const ResultsModel& results);

/// Whom the figures are of: the participant chosen, or everybody.
[[nodiscard]] std::string shown_participant(const ResultsModel& results,
                                            const ResultsViewState& state);

void draw_results_page(Ui& ui, const Rect& place, const ResultsModel& results, ResultsPage page,
                       ResultsViewState& state);
void draw_charts_page(Ui& ui, Rect place, const ResultsModel& results, ResultsViewState& state);
/// `marks`: says here that the data are simulated, for the header has no room to.
void draw_participants(Ui& ui, const Rect& place, const ResultsModel& results, bool marks,
                       ResultsViewState& state);
/// How good the data are, as many lines of chips as it takes. Returns their height.
float draw_quality(Ui& ui, const Rect& place, const ResultsModel& results);

/// "0.72": two digits after the point, as far as it goes.
[[nodiscard]] std::string two_digits(double value);

}  // namespace jnd::app::gui
