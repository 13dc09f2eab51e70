#pragma once

#include <string>
#include <vector>

#include "app/gui/views/record_view.h"

namespace jnd::app::gui {

// The pages of a stored session, a file each.

void draw_record_timeline(Ui& ui, const Rect& place, const SessionRecord& record,
                          RecordViewState& state);
void draw_record_answers(Ui& ui, const Rect& place, const SessionRecord& record,
                         RecordViewState& state);
void draw_record_notes(Ui& ui, const Rect& place, const SessionRecord& record,
                       RecordViewState& state);
void draw_record_faults(Ui& ui, const Rect& place, const RecordViewModel& model,
                        RecordViewState& state, RecordViewResult& result);

/// Asks before anything is written.
void draw_record_dialog(Ui& ui, const SessionRecord& record, RecordViewState& state,
                        RecordViewResult& result);
void begin_record_dialog(RecordViewState& state, RecordViewState::Dialog dialog);
/// Sets the answer that is chosen right.
void begin_correction(const RecordAnswer& answer, RecordViewState& state);

/// Places in `SessionRecord::notes` of those that are shown.
[[nodiscard]] std::vector<std::size_t> shown_notes(const SessionRecord& record,
                                                   const RecordViewState& state);
/// The note that is chosen among them; nullptr for none.
[[nodiscard]] const RecordNote* chosen_note(const SessionRecord& record,
                                            const RecordViewState& state);
/// The answer that is chosen; nullptr for none.
[[nodiscard]] const RecordAnswer* chosen_answer(const SessionRecord& record,
                                                const RecordViewState& state);

}  // namespace jnd::app::gui
