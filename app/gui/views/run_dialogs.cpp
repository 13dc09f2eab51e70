// What is asked before something is undone, noted or left. Escape stays the emergency stop.

#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "app/gui/views/run_parts.h"
#include "app/gui/views/typed_number.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using Dialog = RunViewState::Dialog;
using experiments::AnswerKind;

struct DialogWords {
  const char* title;
  const char* explanation;
  const char* hint;
  const char* verb;
  bool needs_text;
};

DialogWords words_of(Dialog dialog) {
  switch (dialog) {
    case Dialog::kUndo:
      return {tr("Undo the last answer"),
              tr("The answer stays in the log as undone, and its trial is run again."),
              tr("reason"), tr("Undo"), true};
    case Dialog::kCorrect:
      return {tr("Set an answer right"),
              tr("The old answer stays in the log; what was felt is not touched."),
              tr("reason"), tr("Correct"), true};
    case Dialog::kNote:
      return {
          tr("Write a note"),
          tr("It is stored with the time, now. An adverse event, such as pain or a fright, is "
             "kept for good, also if the person withdraws."),
          tr("note"), tr("Store"), true};
    case Dialog::kPause:
      return {tr("Pause the session"),
              tr("The hand goes to free space; a trial under way is run again afterwards."),
              tr("reason (may be left out)"), tr("Pause"), false};
    case Dialog::kEndEarly:
      return {tr("End the session for good"),
              tr("What was answered is kept; the session cannot be resumed."), tr("reason"),
              tr("End"), true};
    case Dialog::kLeave:
      return {tr("Leave the session"),
              tr("Every answer is on disk. The session stays open and can be resumed."),
              tr("reason (may be left out)"), tr("Leave"), false};
    case Dialog::kGoOnEarly:
      return {tr("Go on before the rest is over"), tr("The reason is stored as a note."),
              tr("reason"), tr("Go on"), true};
    case Dialog::kGoOnWithout:
      return {tr("Go on without what came off"),
              tr("Nobody waits for it any more until it holds again; the reason is stored as a "
                 "note."),
              tr("reason"), tr("Go on without it"), true};
    case Dialog::kNone:
      break;
  }
  return {"", "", "", "", false};
}

/// An answer in English, or in the language of the window.
bool is_typed(const RunViewState& state, std::string_view english, std::string_view spoken) {
  return state.correct_value == english || state.correct_value == spoken;
}

/// An answer is set right to "cannot tell", where it can be that.
bool is_cannot_tell(const RunViewState& state) {
  return state.correct_takes_cannot_tell &&
         is_typed(state, as_is("cannot tell"), tr("cannot tell"));
}

/// The new value of an answer that is set right; NaN while there is none.
double corrected_value(const RunViewState& state) {
  if (state.correct_value.empty()) return std::nan("");
  if (state.correct_kind == AnswerKind::kYesNo) {
    if (is_typed(state, "yes", tr("yes"))) return 1.0;
    return is_typed(state, "no", tr("no")) ? 0.0 : std::nan("");
  }
  if (state.correct_kind == AnswerKind::kInterval) {
    if (state.correct_value == "1" || is_typed(state, "first", tr("first"))) return 1.0;
    if (state.correct_value == "2" || is_typed(state, "second", tr("second"))) return 2.0;
    const bool is_third = state.correct_value == "3" || is_typed(state, "third", tr("third"));
    return is_third ? 3.0 : std::nan("");
  }
  const std::optional<double> value = typed_number(state.correct_value);
  if (state.correct_kind == AnswerKind::kStep) {
    return value && *value >= 1.0 && *value == std::floor(*value) ? *value : std::nan("");
  }
  const bool is_answer =
      value && (state.correct_kind == AnswerKind::kNumber ? *value > 0.0 : *value >= 0.0);
  return is_answer ? *value : std::nan("");
}

void request(const SessionView& view, const RunViewState& state, RunViewResult& result) {
  switch (state.dialog) {
    case Dialog::kUndo:
      result.requests.emplace_back(operate::Undo{state.reason});
      break;
    case Dialog::kCorrect: {
      operate::Correct correct{.trial = state.correct_trial, .reason = state.reason};
      correct.value =
          is_cannot_tell(state) ? std::nullopt : std::optional(corrected_value(state));
      result.requests.emplace_back(std::move(correct));
      break;
    }
    case Dialog::kNote:
      result.requests.emplace_back(operate::AddNote{state.reason});
      break;
    case Dialog::kPause:
      result.requests.emplace_back(operate::Pause{state.reason});
      break;
    case Dialog::kEndEarly:
      result.requests.emplace_back(operate::EndEarly{state.reason});
      break;
    case Dialog::kLeave:
      result.requests.emplace_back(operate::Leave{state.reason});
      result.to_sessions = true;
      break;
    case Dialog::kGoOnEarly:
      result.requests.emplace_back(operate::FinishStage{view.stage, state.reason});
      break;
    case Dialog::kGoOnWithout:
      result.requests.emplace_back(operate::GoOnWithout{state.given_up_bits, state.reason});
      break;
    case Dialog::kNone:
      break;
  }
}

}  // namespace

void draw_run_dialog(Ui& ui, const SessionView& view, RunViewState& state,
                     RunViewResult& result) {
  const DialogWords words = words_of(state.dialog);
  const bool corrects = state.dialog == Dialog::kCorrect;
  Rect inside = ui.begin_dialog("dialog", 560, corrects ? 320 : 260);
  ui.text(inside.take_top(34, 4), words.title, {.font = Font::kLarge});
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  ui.text(inside.take_top(ui.text_height(inside.width, words.explanation, soft), 16),
          words.explanation, soft);
  bool entered = false;
  if (corrects) {
    const bool opens = state.correct_takes_cannot_tell;
    const char* hint =
        state.correct_kind == AnswerKind::kYesNo
            ? (opens ? tr("yes, no or cannot tell") : tr("yes or no"))
        : state.correct_kind == AnswerKind::kInterval
            ? (opens ? tr("first, second or cannot tell") : tr("first or second"))
        : state.correct_kind == AnswerKind::kPercent ? tr("percent")
        : state.correct_kind == AnswerKind::kNumber  ? tr("number")
        : state.correct_kind == AnswerKind::kStep    ? tr("step")
                                                     : tr("intensity");
    entered |= ui.text_field("correct_value", inside.take_top(46, 10), state.correct_value,
                             hint, state.dialog_is_new);
    entered |= ui.text_field("reason", inside.take_top(46, 18), state.reason, words.hint);
  } else {
    entered = ui.text_field("reason", inside.take_top(46, 18), state.reason, words.hint,
                            state.dialog_is_new);
  }
  const bool ready =
      (!words.needs_text || !state.reason.empty()) &&
      (!corrects || is_cannot_tell(state) || !std::isnan(corrected_value(state)));
  Rect row = inside.take_bottom(48);
  const ButtonStyle verb{.tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = ready};
  const ButtonStyle cancel{.key = {Key::kF2}};
  const Rect verb_place = row.take_right(ui.button_width(words.verb, verb), 12);
  const Rect cancel_place = row.take_right(ui.button_width(tr("Cancel"), cancel), 12);
  const bool done = ui.button("dialog_do", verb_place, words.verb, verb) || (entered && ready);
  const bool cancelled = ui.button("dialog_cancel", cancel_place, tr("Cancel"), cancel);
  bool adverse = false;
  if (state.dialog == Dialog::kNote) {
    const char* words_of_adverse = tr("Store as adverse event");
    const ButtonStyle style{.enabled = ready};
    adverse = ui.button("dialog_adverse_event",
                        row.take_left(ui.button_width(words_of_adverse, style)),
                        words_of_adverse, style);
  }
  ui.end_dialog();
  if (adverse) result.requests.emplace_back(operate::ReportAdverseEvent{state.reason});
  // Enter without what is needed: the field keeps the keyboard.
  state.dialog_is_new = entered && !done;
  if (done) request(view, state, result);
  if (done || adverse || cancelled) state.dialog = Dialog::kNone;
}

}  // namespace jnd::app::gui
