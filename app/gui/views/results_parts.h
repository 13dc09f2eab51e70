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
/// The pages that have something to show.
[[nodiscard]] std::vector<ResultsPageLook> pages_of(const ResultsModel& results);

/// Whose results the figures show: the chosen participant's, or everybody's.
[[nodiscard]] std::string shown_participant(const ResultsModel& results,
                                            const ResultsViewState& state);

void draw_results_page(Ui& ui, const Rect& place, const ResultsModel& results, ResultsPage page,
                       ResultsViewState& state);
void draw_charts_page(Ui& ui, Rect place, const ResultsModel& results, ResultsViewState& state);
/// `marks` makes it say that the data are simulated, because the header has no room for that.
void draw_participants(Ui& ui, const Rect& place, const ResultsModel& results, bool marks,
                       ResultsViewState& state);
/// Draws chips that tell how good the data are, in as many lines as needed. Returns their
/// height.
float draw_quality(Ui& ui, const Rect& place, const ResultsModel& results);

/// A number as `table_number` writes it, such as "0.72"; "none" if it is not finite.
[[nodiscard]] std::string two_digits(double value);

}  // namespace jnd::app::gui
