#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/live_trace.h"
#include "app/operator/operator_request.h"
#include "app/operator/session_view.h"

namespace jnd::app::gui {

/// An answer that is being set right.
struct CorrectState {
  AnswerLine line;     ///< As it stood when somebody chose it.
  std::string typed;   ///< Where it is a number.
  bool is_new = true;  ///< Its field takes the keyboard.
  bool has_choice = false;
  std::optional<double> value;  ///< What was chosen; none: "cannot tell".
  bool runs_again = false;      ///< Instead of another answer.
  bool asks_why = false;        ///< The field for the reason takes the keyboard.
};

/// What was typed of a step on a scale of more than ten steps.
struct ScaleTyping {
  std::string of;      ///< Which scale it was typed for; another one begins anew.
  std::string digits;  ///< "14"
};

/// What the window remembers of a running session: words being typed, nothing that counts.
struct RunViewState {
  enum class Dialog {
    kNone,
    kUndo,
    kCorrect,
    kNote,
    kWhyPaused,  ///< The session is paused already.
    kEndEarly,
    kLeave,
    kGoOnEarly,
    kGoOnWithout
  };
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;    ///< Its first field takes the keyboard.
  bool is_covered = false;       ///< By a dialog of the application, which then draws the stop.
  bool shows_apparatus = false;  ///< Instead of the card and what is around it.
  std::string reason;            ///< Or the note.
  bool writes_reason = false;    ///< None of those that have a key of their own.
  bool asked_to_pause = false;   ///< The pause that was asked for will have to be explained.
  std::uint8_t given_up_bits = 0;  ///< Points, of the dialog that goes on without them.
  CorrectState correct;            ///< Of the dialog that corrects.

  std::string percent;                                  ///< Typed so far.
  std::int64_t percent_trial = 0, percent_attempt = 0;  ///< What it was typed for.
  ScaleTyping scale;
  std::string item;  ///< Name of the item that `typed` belongs to.
  std::string typed;
  bool says_yes = false;  ///< Of "yes, which?".
  bool item_is_new = false;
  double item_since_s = 0.0;  ///< On the screen; the frames' time.
  std::string changed_item;   ///< Of a questionnaire: answered already, asked again.
  std::string item_problem;   ///< Why what is typed is no answer.
  float consent_height = 0;

  /// Where the mouse moves the hand, and how many metres a logical pixel is; empty without.
  Rect pad;
  double pad_m_per_px = 0.0;
};

/// After the last event: what was checked and where a copy is.
struct AfterSession {
  bool checking = false, backing_up = false;
  double progress = 0.0;
  std::string check, backup;  ///< Sentences; "" before.
  bool check_failed = false, backup_failed = false;
  bool backup_has_caution = false;  ///< It is there, but not as safe as it should be.
  std::string backup_folder;        ///< Known, or proposed.
};

struct RunViewResult {
  std::vector<OperatorRequest> requests;
  bool stop = false;     ///< The emergency stop's button was pressed.
  bool back_up = false;  ///< Into `AfterSession::backup_folder`.
  bool to_results = false;
  bool to_sessions = false;  ///< The session is over, or was left.
};

/// The session under way. `trace`: of the hand, empty where levels are hidden.
[[nodiscard]] RunViewResult draw_run_view(Ui& ui, const SessionView& view,
                                          const std::vector<TracePoint>& trace,
                                          AfterSession& after, RunViewState& state);

/// The button at the right of the header, to be drawn after any dialog: what is drawn below one
/// cannot be used. True when it was pressed.
[[nodiscard]] bool draw_emergency_stop(Ui& ui);
/// How much of the header it takes.
[[nodiscard]] float emergency_stop_width(const Ui& ui);

/// Asks whether to leave a session that goes on, as when the window is being closed.
void ask_to_leave(RunViewState& state);

}  // namespace jnd::app::gui
