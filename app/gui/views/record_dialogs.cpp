// Asks before something is done to a stored session.

#include <algorithm>
#include <string>
#include <variant>

#include "app/gui/views/layout.h"
#include "app/gui/views/record_parts.h"
#include "app/gui/views/run_parts.h"
#include "app/gui/views/typed_number.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using Asked = RecordViewState::Dialog;

struct RecordDialogWords {
  std::string title, explanation, hint, verb;
};

/// True if the chosen trial or session is left out already, so that the dialog includes it
/// again.
bool takes_in_again(const SessionRecord& record, const RecordViewState& state) {
  if (!state.whole_session) {
    const RecordAnswer* answer = chosen_answer(record, state);
    return answer != nullptr && answer->excluded;
  }
  return std::ranges::all_of(record.answers,
                             [](const RecordAnswer& one) { return one.excluded; });
}

RecordDialogWords words_to_exclude(const SessionRecord& record, const RecordViewState& state) {
  const bool again = takes_in_again(record, state);
  RecordDialogWords words{
      .title = again ? tr("Take it into results again") : tr("Leave it out of results"),
      .explanation = "",
      .hint = tr("reason"),
      .verb = again ? tr("Take in") : tr("Leave out")};
  const std::string kept = tr("Nothing is deleted; the reason is kept with the data.");
  if (state.whole_session) {
    words.explanation = trn("{} trial of this session. {}", "All {} trials of this session. {}",
                            std::ssize(record.answers), kept);
  } else if (const RecordAnswer* answer = chosen_answer(record, state)) {
    words.explanation = tr("{}, trial {}, answered {}. {}", answer->block, answer->in_block,
                           in_quotes(answer->answer), kept);
  }
  return words;
}

RecordDialogWords words_of_record_dialog(const SessionRecord& record,
                                         const RecordViewState& state) {
  switch (state.dialog) {
    case Asked::kExclude:
      return words_to_exclude(record, state);
    case Asked::kNote:
      return {.title = tr("Write a note"),
              .explanation = record.is_over
                                 ? tr("It is stored with the time, now. An adverse event, such "
                                      "as pain or a fright, is kept for good, also if the "
                                      "person withdraws.")
                                 : tr("The session is open: an adverse event can be reported, "
                                      "and notes are written when it is resumed."),
              .hint = tr("note"),
              .verb = tr("Store")};
    case Asked::kWithdraw:
      return {.title = tr("Withdraw {}", record.line.participant),
              .explanation = tr(
                  "This deletes every answer and every sample of {}, here and in the backups "
                  "that the study knows of, for good. There is no way back. Write the "
                  "pseudonym once more to go on.",
                  record.line.participant),
              .hint = tr("pseudonym"),
              .verb = tr("Delete for good")};
    case Asked::kNone:
      break;
  }
  return {};
}

void ask_for_it(const SessionRecord& record, const RecordViewState& state,
                RecordViewResult& result) {
  switch (state.dialog) {
    case Asked::kExclude: {
      RecordViewResult::Exclude exclude{.reason = state.typed,
                                        .include = takes_in_again(record, state)};
      if (state.whole_session) {
        for (const RecordAnswer& answer : record.answers) {
          exclude.trials.push_back(answer.trial);
        }
      } else if (const RecordAnswer* answer = chosen_answer(record, state)) {
        exclude.trials = {answer->trial};
      }
      result.exclude = std::move(exclude);
      return;
    }
    case Asked::kNote:
      result.note = state.typed;
      return;
    case Asked::kWithdraw:
      result.withdraw = true;
      return;
    case Asked::kNone:
      return;
  }
}

void draw_correction(Ui& ui, RecordViewState& state, RecordViewResult& result) {
  RunViewResult asked;
  draw_correct_dialog(ui, state.correcting, {}, asked);
  for (const OperatorRequest& request : asked.requests) {
    if (const auto* correct = std::get_if<operate::Correct>(&request)) {
      result.correct = {correct->trial, correct->value, correct->reason};
    }
  }
}

}  // namespace

void begin_record_dialog(RecordViewState& state, RecordViewState::Dialog dialog) {
  state.dialog = dialog;
  state.dialog_is_new = true;
  state.typed.clear();
}

void begin_correction(const RecordAnswer& answer, RecordViewState& state) {
  state.correcting = {};
  state.correcting.dialog = RunViewState::Dialog::kCorrect;
  state.correcting.correct.line = {.trial = answer.trial,
                                   .in_block = answer.in_block,
                                   .block = answer.block,
                                   .answer = answer.answer,
                                   .form = answer.form,
                                   .response_time_s = answer.response_time_s.value_or(0.0)};
}

void draw_record_dialog(Ui& ui, const SessionRecord& record, RecordViewState& state,
                        RecordViewResult& result) {
  if (state.correcting.dialog == RunViewState::Dialog::kCorrect) {
    return draw_correction(ui, state, result);
  }
  if (state.dialog == Asked::kNone) return;
  const RecordDialogWords words = words_of_record_dialog(record, state);
  constexpr float kWidth = 620;
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const bool is_note = state.dialog == Asked::kNote;
  const char* adverse_words = tr("Store as adverse event");
  const float explained = ui.text_height(kWidth - 56, words.explanation, soft);
  const float above = is_note ? adverse_row(ui, kWidth - 56, words.verb, adverse_words) : 0;
  Rect inside =
      ui.begin_dialog("record_dialog", kWidth, 56 + 38 + explained + 16 + 46 + 18 + 48 + above);
  ui.text(inside.take_top(34, 4), words.title, {.font = Font::kLarge});
  ui.text(inside.take_top(explained, 16), words.explanation, soft);
  const bool entered = ui.text_field("reason", inside.take_top(46, 18), state.typed, words.hint,
                                     state.dialog_is_new);
  const bool is_withdrawal = state.dialog == Asked::kWithdraw;
  const bool has_text =
      is_withdrawal ? state.typed == record.line.participant : !is_blank(state.typed);
  const bool ready = has_text && (!is_note || record.is_over);
  Rect row = inside.take_bottom(48);
  const ButtonStyle verb{.tone = is_withdrawal ? Tone::kDanger : Tone::kPrimary,
                         .key = {Key::kEnter},
                         .enabled = ready};
  const Rect place = row.take_right(ui.button_width(words.verb, verb), 12);
  const bool done = ui.button("dialog_do", place, words.verb, verb) || (entered && ready);
  const ButtonStyle cancel{.key = {Key::kF2}};
  const bool cancelled =
      ui.button("dialog_cancel", row.take_right(ui.button_width(tr("Cancel"), cancel), 12),
                tr("Cancel"), cancel);
  bool adverse = false;
  if (is_note) {
    const ButtonStyle style{.key = {letter('E'), true}, .enabled = has_text};
    if (above > 0) row = inside.take_bottom(48, 8);
    adverse =
        ui.button("dialog_adverse_event", row.take_left(ui.button_width(adverse_words, style)),
                  adverse_words, style);
  }
  ui.end_dialog();
  // After Enter without the necessary words, the field keeps the keyboard.
  state.dialog_is_new = entered && !done;
  if (adverse) result.adverse_event = state.typed;
  if (done) ask_for_it(record, state, result);
  if (done || adverse || cancelled) state.dialog = Asked::kNone;
}

}  // namespace jnd::app::gui
