// Corrects an earlier answer, with the buttons or the field of its trial, or by running the
// trial again. The dialog asks for the answer first, and then for the reason.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/gui/views/run_parts.h"
#include "app/gui/views/typed_number.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using experiments::AnswerKind;

constexpr float kCorrectButton = 52;
constexpr float kCorrectScale = 96;

bool is_typed_again(const AnswerForm& form) {
  return form.kind == AnswerKind::kPercent || form.kind == AnswerKind::kNumber ||
         form.kind == AnswerKind::kMatch;
}

/// Why what was typed is no answer; "" if it is one, or if nothing was typed yet.
std::string problem_of_correction(const AnswerForm& form, const std::string& typed) {
  if (is_blank(typed)) return "";
  const std::optional<double> value = typed_number(typed);
  if (!value) return tr("expected a number, found “{}”", typed);
  if (form.kind == AnswerKind::kNumber && !(*value > 0.0))
    return tr("expected a number above 0");
  if (!(*value >= 0.0)) return tr("expected a number of 0 or more");
  return "";
}

class CorrectDialog {
 public:
  CorrectDialog(Ui& ui, CorrectState& state) : ui_(ui), state_(state), form_(state.line.form) {}

  /// The height of what this draws in a dialog of this width.
  [[nodiscard]] float height(float width) const {
    if (is_typed_again(form_)) {
      return form_.is_hidden ? ui_.text_height(width, hidden_words(), kHiddenStyle) + 18
                             : 46.0f + 6 + 22 + 8;
    }
    return form_.kind == AnswerKind::kStep ? kCorrectScale + 14 : kCorrectButton + 18;
  }

  /// Draws the answer that is to be stored instead.
  void draw_answer(Rect& inside) {
    if (is_typed_again(form_)) return draw_field(inside);
    if (form_.kind == AnswerKind::kStep) {
      const int selected =
          state_.has_choice && state_.value ? static_cast<int>(std::lround(*state_.value)) : 0;
      const int step = draw_scale(ui_, inside.take_top(kCorrectScale, 14),
                                  {.name = "correct_step_",
                                   .of = std::to_string(state_.line.trial),
                                   .num_steps = form_.num_steps,
                                   .low_label = form_.low_label,
                                   .high_label = form_.high_label,
                                   .selected = selected},
                                  state_.scale);
      if (step > 0) choose(step);
      return;
    }
    draw_buttons(inside.take_top(kCorrectButton, 18));
  }

 private:
  void choose(std::optional<double> value) {
    state_.has_choice = true;
    state_.runs_again = false;
    state_.value = value;
    state_.asks_why = true;
  }

  static constexpr TextStyle kHiddenStyle{.colour = Colour::kSoft, .wrap = true};
  [[nodiscard]] const char* hidden_words() const {
    return state_.line.can_run_again
               ? tr("What was set is hidden and cannot be typed. Run the trial again.")
               : tr("What was set is hidden and cannot be typed, and its block is over. "
                    "Write a note.");
  }

  void draw_field(Rect& inside) {
    if (form_.is_hidden) {
      const char* words = hidden_words();
      ui_.text(inside.take_top(ui_.text_height(inside.width, words, kHiddenStyle), 18), words,
               kHiddenStyle);
      return;
    }
    const char* hint = form_.kind == AnswerKind::kPercent  ? tr("percent")
                       : form_.kind == AnswerKind::kNumber ? tr("number")
                                                           : tr("what was set");
    Rect row = inside.take_top(46, 6);
    const std::string unit = form_.kind == AnswerKind::kPercent ? "%" : form_.unit;
    if (!unit.empty()) {
      ui_.text(row.take_right(ui_.text_width(unit, Font::kBody) + 4, 10), unit, {});
    }
    const std::string before = state_.typed;
    const bool entered =
        ui_.text_field("correct_value", row, state_.typed, hint, state_.is_new);
    if (state_.typed != before) state_.runs_again = false;
    const std::string problem = problem_of_correction(form_, state_.typed);
    ui_.text(inside.take_top(22, 8), problem, {.font = Font::kSmall, .colour = Colour::kAmber});
    const std::optional<double> value = typed_number(state_.typed);
    state_.has_choice = value && problem.empty();
    state_.value = state_.has_choice ? value : std::nullopt;
    // The field keeps the keyboard.
    state_.is_new = entered && !state_.has_choice;
    if (entered && state_.has_choice) state_.asks_why = true;
  }

  void draw_buttons(const Rect& place) {
    std::vector<RowButton> buttons;
    const auto add = [&](const char* name, const std::string& label, char key,
                         std::optional<double> value) {
      const bool selected = state_.has_choice && !state_.runs_again && state_.value == value;
      buttons.push_back(
          {name, label, {.key = {letter(key)}, .selected = selected}, [this, value] {
             choose(value);
           }});
    };
    if (form_.kind == AnswerKind::kYesNo) {
      add("correct_yes", form_.yes_label, 'Y', 1.0);
      add("correct_no", form_.no_label, 'N', 0.0);
    }
    constexpr const char* kNames[] = {"correct_first", "correct_second", "correct_third"};
    for (const TrialView::Choice& choice : form_.choices) {
      add(kNames[choice.interval - 1], choice.label, static_cast<char>('0' + choice.interval),
          choice.interval);
    }
    const std::string cannot_tell = tr("Cannot tell");
    if (form_.takes_cannot_tell) add("correct_cannot_tell", cannot_tell, 'C', std::nullopt);
    const auto count = static_cast<float>(std::max<std::size_t>(buttons.size(), 1));
    draw_button_row(ui_, place, buttons, std::min(240.0f, (place.width - 40) / count));
  }

  Ui& ui_;
  CorrectState& state_;
  const AnswerForm& form_;
};

/// The answer before that of a trial; of the oldest, the newest. Nothing without another.
const AnswerLine* earlier_answer(const std::vector<AnswerLine>& answers, std::int64_t trial) {
  if (answers.size() < 2) return nullptr;
  for (std::size_t i = 0; i + 1 < answers.size(); ++i) {
    if (answers[i].trial == trial) return &answers[i + 1];
  }
  return &answers.front();
}

}  // namespace

void draw_correct_dialog(Ui& ui, RunViewState& run, const std::vector<AnswerLine>& answers,
                         RunViewResult& result) {
  CorrectState& state = run.correct;
  const AnswerLine& line = state.line;
  bool turns_to_earlier = false;
  CorrectDialog dialog(ui, state);
  constexpr float kWidth = 680, kInside = kWidth - 2 * 28;
  const TextStyle strong{.font = Font::kStrong, .wrap = true};
  const std::string which =
      tr("{}, trial {}: the answer was {}.", line.block, line.in_block, in_quotes(line.answer));
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const char* words = tr("The old answer stays in the log; what was felt is not touched.");
  const char* verb = state.runs_again ? tr("Run it again") : tr("Correct");
  const ButtonStyle again{.key = {Key::kF5}, .selected = state.runs_again};
  const char* again_words = tr("Run the trial again");
  // The button is beside the other two if all three have room.
  const float of_buttons = ui.button_width(again_words, again) + 12 +
                           ui.button_width(tr("Cancel"), {.key = {Key::kEnter}}) + 12 +
                           ui.button_width(verb, {.key = {Key::kEnter}});
  const float above = line.can_run_again && of_buttons > kInside ? 48 + 8 : 0;
  const float of_words =
      ui.text_height(kInside, which, strong) + 4 + ui.text_height(kInside, words, soft) + 14;
  Rect inside = ui.begin_dialog(
      "dialog", kWidth,
      2 * 28 + 38 + of_words + dialog.height(kInside) + 46 + 14 + 20 + 48 + above);
  Rect head = inside.take_top(34, 4);
  const AnswerLine* const earlier = earlier_answer(answers, line.trial);
  if (earlier != nullptr) {
    const ButtonStyle style{.tone = Tone::kQuiet, .key = {Key::kF3}};
    const char* const label = tr("The answer before");
    turns_to_earlier = ui.button(
        "correct_earlier", head.take_right(ui.button_width(label, style), 12), label, style);
  }
  ui.text(head, tr("Set an answer right"), {.font = Font::kLarge});
  ui.text(inside.take_top(ui.text_height(inside.width, which, strong), 4), which, strong);
  ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 14), words, soft);
  dialog.draw_answer(inside);
  const bool is_ready = state.has_choice || state.runs_again;
  bool entered = false;
  if (is_ready || state.asks_why) {
    entered = ui.text_field("reason", inside.take_top(46, 14), run.reason, tr("reason"),
                            std::exchange(state.asks_why, false));
  }
  Rect row = inside.take_bottom(48);
  const bool may_store = is_ready && !is_blank(run.reason);
  const ButtonStyle store{.tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = may_store};
  const Rect place = row.take_right(ui.button_width(verb, store), 12);
  const bool done = ui.button("dialog_do", place, verb, store) || (entered && may_store);
  const ButtonStyle cancel{.key = {Key::kF2}};
  const bool cancelled =
      ui.button("dialog_cancel", row.take_right(ui.button_width(tr("Cancel"), cancel), 12),
                tr("Cancel"), cancel);
  if (line.can_run_again) {
    if (above > 0) row = inside.take_bottom(48, 8);
    const Rect at_left = row.take_left(ui.button_width(again_words, again));
    if (ui.button("correct_run_again", at_left, again_words, again)) {
      state.runs_again = state.asks_why = true;
    }
  }
  ui.end_dialog();
  if (entered && !done)
    // No reason was typed, so the field keeps the keyboard.
    state.asks_why = true;
  if (done && state.runs_again) {
    result.requests.emplace_back(operate::RunAgain{line.trial, run.reason});
  } else if (done) {
    result.requests.emplace_back(
        operate::Correct{.trial = line.trial, .value = state.value, .reason = run.reason});
  }
  if (done || cancelled) run.dialog = RunViewState::Dialog::kNone;
  // Last, for everything above is of the answer that was shown.
  if (turns_to_earlier && !done && !cancelled) {
    run.correct = {.line = *earlier};
    run.reason.clear();
  }
}

void draw_doubt_dialog(Ui& ui, const DoubtView& doubt, RunViewResult& result) {
  const TextStyle style{.font = Font::kLarge, .wrap = true};
  constexpr float kWidth = 620;
  const float words = ui.text_height(kWidth - 56, doubt.sentence, style);
  Rect inside = ui.begin_dialog("doubt", kWidth, 56 + 40 + words + 24 + 52);
  ui.text(inside.take_top(34, 6), tr("Store this answer?"), {.font = Font::kTitle});
  ui.text(inside.take_top(words, 24), doubt.sentence, style);
  Rect row = inside.take_bottom(52);
  // Enter does not store, because whoever presses it twice has not read the question.
  const ButtonStyle store{.key = {letter('S')}};
  const ButtonStyle back{.tone = Tone::kPrimary, .key = {Key::kF2}};
  const Rect store_place = row.take_right(ui.button_width(tr("Store it"), store), 12);
  if (ui.button("doubt_store", store_place, tr("Store it"), store)) {
    result.requests.emplace_back(operate::StoreDoubted{doubt.trial});
  }
  const Rect back_place = row.take_right(ui.button_width(tr("Go back"), back), 12);
  if (ui.button("doubt_go_back", back_place, tr("Go back"), back)) {
    result.requests.emplace_back(operate::GoBack{doubt.trial});
  }
  ui.end_dialog();
}

}  // namespace jnd::app::gui
