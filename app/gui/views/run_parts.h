#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/gui/views/run_view.h"
#include "app/gui/views/stack.h"

namespace jnd::app::gui {

// The parts of the run view, each in a file of its own.

inline constexpr float kRunHeader = 56;

void draw_run_header(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state,
                     RunViewResult& result);
void draw_run_footer(Ui& ui, const Rect& place, const SessionView& view);
void draw_stage_list(Ui& ui, const Rect& place, const SessionView& view);
void draw_progress_card(Ui& ui, const Rect& place, const SessionView& view);
void draw_answers(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state);
void draw_live_panel(Ui& ui, const Rect& place, const SessionView& view,
                     const std::vector<TracePoint>& trace);
void draw_correct_dialog(Ui& ui, RunViewState& run, RunViewResult& result);
/// Draws the dialog about an answer that seems doubtful. It lies over everything else while the
/// session waits; S stores the answer, and F2 goes back.
void draw_doubt_dialog(Ui& ui, const DoubtView& doubt, RunViewResult& result);
void draw_run_dialog(Ui& ui, const SessionView& view, RunViewState& state,
                     RunViewResult& result);

/// Draws the card in the middle, which depends on what the session waits for.
void draw_run_card(Ui& ui, const Rect& place, const SessionView& view,
                   const std::vector<TracePoint>& trace, AfterSession& after,
                   RunViewState& state, RunViewResult& result);
void draw_trial_card(Ui& ui, const Rect& place, const SessionView& view,
                     const std::vector<TracePoint>& trace, RunViewState& state,
                     RunViewResult& result);
void draw_item_card(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state,
                    RunViewResult& result);
void draw_after_card(Ui& ui, const Rect& place, const SessionView& view, AfterSession& after,
                     RunViewState& state, RunViewResult& result);
/// The height of the pad on a card with `below` logical pixels of other things. It is half of
/// the card if the rest has room, so that the pad keeps its size from step to step.
[[nodiscard]] float pad_height(const Rect& card, float below) noexcept;
/// Draws the pad on which the mouse moves the hand.
void draw_pad(Ui& ui, const Rect& place, const SessionView& view,
              const std::vector<TracePoint>& trace, RunViewState& state);

/// Draws a scale as on paper: a row of steps, counted from 1, between two words. The keys are
/// the numbers themselves, with 0 for ten. `name` begins the names of the buttons. `selected`
/// is the step chosen so far, or 0 for none. Returns the step that was chosen in this frame, or
/// 0.
[[nodiscard]] int draw_scale(Ui& ui, const Rect& place, const std::string& name, int num_steps,
                             const std::string& low_label, const std::string& high_label,
                             int selected = 0);

/// The height of an extra row for "Store as adverse event" above the buttons of a dialog with
/// this width of `room`; 0 if the button fits beside them.
[[nodiscard]] float adverse_row(const Ui& ui, float room, std::string_view verb,
                                std::string_view adverse);

void open_dialog(RunViewState& state, RunViewState::Dialog dialog);
/// Asks for the reason once the pause that was requested here has begun.
void ask_why_paused(const SessionView& view, RunViewState& state);

/// Minutes and seconds, such as "41:07"; with hours, such as "1:02:03".
[[nodiscard]] std::string clock_words(double seconds);
/// A duration in round words: "18 min", "40 s".
[[nodiscard]] std::string about_words(double seconds);
/// The words in typographic quotes; "" if there are none.
[[nodiscard]] std::string in_quotes(std::string_view words);

}  // namespace jnd::app::gui
