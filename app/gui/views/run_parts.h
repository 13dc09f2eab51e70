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
/// `answers`: those that it can be turned to, the newest first; none turns it to no other.
void draw_correct_dialog(Ui& ui, RunViewState& run, const std::vector<AnswerLine>& answers,
                         RunViewResult& result);
/// Over everything while it waits: the answer is stored or not, by S and F2.
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

/// A scale as on paper: a row of steps from 1 between two words.
struct ScaleForm {
  std::string name;  ///< What the names of its buttons begin with: "step_".
  std::string of;    ///< Tells it from the scales before it: trial and attempt, or the item.
  int num_steps = 10;
  std::string low_label, high_label;
  int selected = 0;  ///< The step that stands; 0 for none.
};

/// Returns the step that was chosen in this frame, or 0. Up to ten steps are chosen by one key
/// each, the digit itself and 0 for ten. Of more steps the number is typed and Enter chooses
/// it; steps that have no room for a button each are typed alone.
[[nodiscard]] int draw_scale(Ui& ui, const Rect& place, const ScaleForm& form,
                             ScaleTyping& typing);

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
