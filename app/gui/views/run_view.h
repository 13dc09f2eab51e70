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

/// What was typed of a step on a scale of more than ten steps.
struct ScaleTyping {
  std::string of;      ///< Which scale it was typed for; another one begins anew.
  std::string digits;  ///< "14"
};

/// An answer that is being corrected.
struct CorrectState {
  AnswerLine line;     ///< The answer as it was when somebody chose it.
  std::string typed;   ///< The text typed for a numeric answer.
  bool is_new = true;  ///< The answer's field gets the keyboard.
  bool has_choice = false;
  std::optional<double> value;  ///< The value that was chosen; none means "cannot tell".
  bool runs_again = false;      ///< The trial is run again instead of changing its answer.
  bool asks_why = false;        ///< The reason's field gets the keyboard.
  /// What was typed of a long scale. The card below the dialog has its own.
  ScaleTyping scale;
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
  bool dialog_is_new = false;  ///< The dialog's first field gets the keyboard.
  /// A dialog of the application covers the view; the application then draws the stop.
  bool is_covered = false;
  /// The apparatus is shown instead of the card and what is around it.
  bool shows_apparatus = false;
  std::string reason;  ///< The reason, or the note.
  /// The operator types a reason instead of choosing one by its key.
  bool writes_reason = false;
  /// The operator asked for a pause, which has to be explained once it has begun.
  bool asked_to_pause = false;
  /// The points that the operator gives up, one bit each, in the dialog that goes on without
  /// them.
  std::uint8_t given_up_bits = 0;
  CorrectState correct;  ///< The state of the dialog that corrects an answer.

  std::string percent;                                  ///< Typed so far.
  std::int64_t percent_trial = 0, percent_attempt = 0;  ///< What it was typed for.
  ScaleTyping scale;
  std::string item;  ///< Name of the item that `typed` belongs to.
  std::string typed;
  bool says_yes = false;  ///< The answer to "yes, which?" is yes so far.
  bool item_is_new = false;
  /// Since when the item has been on the screen, in the frames' time.
  double item_since_s = 0.0;
  /// An item of a questionnaire that was answered already and is asked again.
  std::string changed_item;
  std::string item_problem;  ///< Why what was typed is no answer.
  float consent_height = 0;

  /// The place where the mouse moves the hand, and the metres for each logical pixel. The place
  /// is empty if there is no pad.
  Rect pad;
  double pad_m_per_px = 0.0;
};

/// The check and the backup after the session's last event.
struct AfterSession {
  bool checking = false, backing_up = false;
  double progress = 0.0;
  /// How the check and the backup ended, in a sentence each; "" before.
  std::string check, backup;
  bool check_failed = false, backup_failed = false;
  /// The backup was made, but it is not as safe as it should be.
  bool backup_has_caution = false;
  std::string backup_folder;  ///< A known backup's folder, or a proposal.
};

struct RunViewResult {
  std::vector<OperatorRequest> requests;
  bool stop = false;     ///< The button of the emergency stop was pressed.
  bool back_up = false;  ///< Backs the study up into `AfterSession::backup_folder`.
  bool to_results = false;
  bool to_sessions = false;  ///< The session is over, or was left.
};

/// Draws the session under way. `trace` is the hand's way; it is empty where levels are hidden.
[[nodiscard]] RunViewResult draw_run_view(Ui& ui, const SessionView& view,
                                          const std::vector<TracePoint>& trace,
                                          AfterSession& after, RunViewState& state);

/// Draws the emergency stop at the right of the header. Draw it after any dialog, because what
/// is drawn below one cannot be used. Returns true when it was pressed.
[[nodiscard]] bool draw_emergency_stop(Ui& ui);
/// The width that the stop takes of the header.
[[nodiscard]] float emergency_stop_width(const Ui& ui);

/// Asks whether to leave a session that goes on, for example when the window is being closed.
void ask_to_leave(RunViewState& state);

}  // namespace jnd::app::gui
