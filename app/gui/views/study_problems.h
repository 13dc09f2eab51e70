#pragma once

#include "app/gui/views/study_view.h"

namespace jnd::app::gui {

/// Draws every problem of a study file at its line, in the words of `jnd validate`, with the
/// file's text around it. Arrow keys go from one problem to the next.
void draw_study_problems(Ui& ui, const Rect& place, const StudyOutline& outline,
                         StudyViewState& state, StudyViewResult& result);

/// Draws what a valid file may not mean, in fewer words.
void draw_study_doubts(Ui& ui, const Rect& place, const StudyOutline& outline);

}  // namespace jnd::app::gui
