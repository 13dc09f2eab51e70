#pragma once

#include "app/gui/plot.h"
#include "app/gui/views/data_view.h"
#include "app/operator/column_roles.h"

namespace jnd::app::gui {

// The parts of the view of somebody's table: what is asked at the left, a page of what there is
// beside it, and the dialogs of both.

void open_data_dialog(DataViewState& state, DataViewState::Dialog dialog,
                      const std::string& typed = "");

/// Which columns are what, and which curve is fitted.
void draw_data_settings(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                        DataViewResult& result);
/// The first rows. A click on a column's head asks what it is.
void draw_data_table(Ui& ui, const Rect& place, const DataView& data, DataViewState& state);
/// The curves, the table of fits, and every number of one of them.
void draw_data_curves(Ui& ui, Rect place, const DataView& data, DataViewState& state,
                      DataViewResult& result);
void draw_data_comparison(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                          DataViewResult& result);
void draw_data_command(Ui& ui, const Rect& place, const DataView& data, DataViewState& state);
void draw_data_dialog(Ui& ui, const DataView& data, const EntriesOf& entries_of,
                      DataViewState& state, DataViewResult& result);

/// "intensity", as a column is called by what it is; "" for nothing.
[[nodiscard]] std::string role_words(ColumnRole role);
/// Of a curve among several.
[[nodiscard]] Colour group_colour(std::size_t group) noexcept;
/// Answers, curves and thresholds of up to six groups, each in its colour; of more the one that
/// is chosen, and the other curves faintly.
[[nodiscard]] PlotModel data_plot(const DataResults& results, std::size_t chosen);

}  // namespace jnd::app::gui
