#pragma once

#include "app/gui/plot.h"
#include "app/gui/views/data_view.h"
#include "app/operator/column_roles.h"

namespace jnd::app::gui {

// The parts of the view of somebody's table: the settings at the left, the page beside them,
// and the dialogs of both.

void open_data_dialog(DataViewState& state, DataViewState::Dialog dialog,
                      const std::string& typed = "");

/// Draws the settings: the roles of the columns, and which curve is fitted.
void draw_data_settings(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                        DataViewResult& result);
/// Draws the first rows. A click on a column's head asks what the column is.
void draw_data_table(Ui& ui, const Rect& place, const DataView& data, DataViewState& state);
/// Draws the curves, the table of fits, and every number of one of them.
void draw_data_curves(Ui& ui, Rect place, const DataView& data, DataViewState& state,
                      DataViewResult& result);
void draw_data_comparison(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                          DataViewResult& result);
void draw_data_command(Ui& ui, const Rect& place, const DataView& data, DataViewState& state);
void draw_data_dialog(Ui& ui, const DataView& data, const EntriesOf& entries_of,
                      DataViewState& state, DataViewResult& result);

/// The word for a column's role, such as "intensity"; "" for none.
[[nodiscard]] std::string role_words(ColumnRole role);
/// The colour of this group among several.
[[nodiscard]] Colour group_colour(std::size_t group) noexcept;
/// Answers, curves and thresholds of up to six groups, each in its colour. If there are more
/// groups, the chosen one is in colour, and the other curves are faint.
[[nodiscard]] PlotModel data_plot(const DataResults& results, std::size_t chosen);

}  // namespace jnd::app::gui
