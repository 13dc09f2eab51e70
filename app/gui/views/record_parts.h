#pragma once

#include <string>
#include <vector>

#include "app/gui/views/record_view.h"

namespace jnd::app::gui {

// The pages of a stored session, each in a file of its own.

void draw_record_timeline(Ui& ui, const Rect& place, const SessionRecord& record,
                          RecordViewState& state);
void draw_record_answers(Ui& ui, const Rect& place, const SessionRecord& record,
                         RecordViewState& state);
void draw_record_notes(Ui& ui, const Rect& place, const SessionRecord& record,
                       RecordViewState& state);
void draw_record_faults(Ui& ui, const Rect& place, const RecordViewModel& model,
                        RecordViewState& state, RecordViewResult& result);

/// Draws the dialog that asks before anything is stored.
void draw_record_dialog(Ui& ui, const SessionRecord& record, RecordViewState& state,
                        RecordViewResult& result);
void begin_record_dialog(RecordViewState& state, RecordViewState::Dialog dialog);
/// Begins the dialog that corrects the chosen answer.
void begin_correction(const RecordAnswer& answer, RecordViewState& state);

/// The indices in `SessionRecord::notes` of the notes that are shown.
[[nodiscard]] std::vector<std::size_t> shown_notes(const SessionRecord& record,
                                                   const RecordViewState& state);
/// The chosen note among those shown; nullptr if none is.
[[nodiscard]] const RecordNote* chosen_note(const SessionRecord& record,
                                            const RecordViewState& state);
/// The chosen answer; nullptr if none is.
[[nodiscard]] const RecordAnswer* chosen_answer(const SessionRecord& record,
                                                const RecordViewState& state);

}  // namespace jnd::app::gui
