// The dialogs that ask before something is undone, noted or left. Escape remains the emergency
// stop in them.

#include <algorithm>
#include <span>
#include <utility>

#include "app/gui/views/run_parts.h"
#include "app/gui/views/typed_number.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using Dialog = RunViewState::Dialog;

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
    case Dialog::kNote:
      return {
          tr("Write a note"),
          tr("It is stored with the time, now. An adverse event, such as pain or a fright, is "
             "kept for good, also if the person withdraws."),
          tr("note"), tr("Store"), true};
    case Dialog::kWhyPaused:
      return {
          tr("Paused. Why?"),
          tr("The hand is in free space, and the pause is on disk. A trial under way is run "
             "again afterwards."),
          tr("reason"), tr("Store the reason"), true};
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
    case Dialog::kCorrect:
    case Dialog::kNone:
      break;
  }
  return {"", "", "", "", false};
}

// Reasons that are chosen by one key. A study stores them in these English words, whatever the
// window's language is.
constexpr const char* kPauseReasons[] = {
    tr_later("the participant needs a rest"), tr_later("the participant has a question"),
    tr_later("the device is looked after"), tr_later("an interruption from outside")};
constexpr const char* kUndoReasons[] = {
    tr_later("the participant corrects the answer"), tr_later("the wrong key was pressed"),
    tr_later("the answer was misheard"), tr_later("the stimulus was not felt properly")};

std::span<const char* const> reasons_of(Dialog dialog) {
  if (dialog == Dialog::kWhyPaused) return kPauseReasons;
  if (dialog == Dialog::kUndo) return kUndoReasons;
  return {};
}

float room_of_dialog(const Ui& ui, float width) {
  return std::min(width, ui.screen().width - 24) - 2 * 28;
}

constexpr float kReasonRow = 42;
constexpr float kReasonGap = 8;

/// Draws the reasons below each other, with number keys; the last one is for words of one's
/// own. Returns true when one was chosen.
bool draw_reasons(Ui& ui, Rect& inside, RunViewState& state) {
  const std::span<const char* const> reasons = reasons_of(state.dialog);
  bool is_chosen = false;
  for (std::size_t i = 0; i <= reasons.size(); ++i) {
    const bool is_own = i == reasons.size();
    const std::string number = std::to_string(i + 1);
    const Rect row = inside.take_top(kReasonRow, kReasonGap);
    const ButtonStyle style{.key = {letter(static_cast<char>('1' + i))}};
    const char* label = is_own ? tr("another reason …") : tr(reasons[i]);
    if (!ui.button("reason_" + number, row, label, style)) continue;
    if (is_own) {
      state.writes_reason = state.dialog_is_new = true;
    } else {
      state.reason = reasons[i];
      is_chosen = true;
    }
  }
  return is_chosen;
}

void request(const SessionView& view, const RunViewState& state, RunViewResult& result) {
  switch (state.dialog) {
    case Dialog::kUndo:
      result.requests.emplace_back(operate::Undo{state.reason});
      break;
    case Dialog::kNote:
      result.requests.emplace_back(operate::AddNote{state.reason});
      break;
    case Dialog::kWhyPaused:
      result.requests.emplace_back(operate::ExplainPause{state.reason});
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
    case Dialog::kCorrect:
    case Dialog::kNone:
      break;
  }
}

}  // namespace

float adverse_row(const Ui& ui, float room, std::string_view verb, std::string_view adverse) {
  const ButtonStyle with_key{.key = {Key::kEnter}};
  const float wanted = ui.button_width(adverse, {.key = {letter('E'), true}}) + 12 +
                       ui.button_width(tr("Cancel"), with_key) + 12 +
                       ui.button_width(verb, with_key);
  return wanted <= room ? 0 : 48 + 8;
}

void draw_run_dialog(Ui& ui, const SessionView& view, RunViewState& state,
                     RunViewResult& result) {
  if (state.dialog == Dialog::kCorrect)
    return draw_correct_dialog(ui, state, view.answers, result);
  const DialogWords words = words_of(state.dialog);
  const bool has_reasons = !reasons_of(state.dialog).empty() && !state.writes_reason;
  const float rows = static_cast<float>(reasons_of(state.dialog).size() + 1);
  constexpr float kWidth = 560;
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const float room = room_of_dialog(ui, kWidth);
  const float explained = ui.text_height(room, words.explanation, soft);
  const bool is_note = state.dialog == Dialog::kNote;
  const char* words_of_adverse = tr("Store as adverse event");
  const float above = is_note ? adverse_row(ui, room, words.verb, words_of_adverse) : 0;
  const float answers =
      has_reasons ? rows * (kReasonRow + kReasonGap) + 10 : 46.0f + 18 + above;
  Rect inside = ui.begin_dialog("dialog", kWidth, 2 * 28 + 38 + explained + 16 + answers + 48);
  ui.text(inside.take_top(34, 4), words.title, {.font = Font::kLarge});
  ui.text(inside.take_top(ui.text_height(inside.width, words.explanation, soft), 16),
          words.explanation, soft);
  bool entered = false;
  bool is_chosen = false;
  if (has_reasons) {
    is_chosen = draw_reasons(ui, inside, state);
  } else {
    entered = ui.text_field("reason", inside.take_top(46, 18), state.reason, words.hint,
                            state.dialog_is_new);
  }
  const bool ready = !words.needs_text || !is_blank(state.reason);
  Rect row = inside.take_bottom(48);
  const ButtonStyle verb{.tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = ready};
  const ButtonStyle cancel{.key = {Key::kF2}};
  bool done = is_chosen;
  if (!has_reasons) {
    const Rect place = row.take_right(ui.button_width(words.verb, verb), 12);
    done = ui.button("dialog_do", place, words.verb, verb) || (entered && ready);
  }
  const char* leave = state.dialog == Dialog::kWhyPaused ? tr("Give no reason") : tr("Cancel");
  const Rect cancel_place = row.take_right(ui.button_width(leave, cancel), 12);
  const bool cancelled = ui.button("dialog_cancel", cancel_place, leave, cancel);
  bool adverse = false;
  if (is_note) {
    const ButtonStyle style{.key = {letter('E'), true}, .enabled = ready};
    if (above > 0) row = inside.take_bottom(48, 8);
    adverse = ui.button("dialog_adverse_event",
                        row.take_left(ui.button_width(words_of_adverse, style)),
                        words_of_adverse, style);
  }
  ui.end_dialog();
  if (adverse) result.requests.emplace_back(operate::ReportAdverseEvent{state.reason});
  // After Enter without the necessary words, the field keeps the keyboard.
  const bool opens_field = has_reasons && state.writes_reason;
  state.dialog_is_new = (entered && !done) || opens_field;
  if (done) request(view, state, result);
  if (done || adverse || cancelled) state.dialog = Dialog::kNone;
}

}  // namespace jnd::app::gui
