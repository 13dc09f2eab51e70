// The card of a checklist's item, a consent or a question.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "app/gui/views/layout.h"
#include "app/gui/views/run_parts.h"
#include "app/gui/views/typed_number.h"
#include "app/language/words.h"
#include "app/operator/session_words.h"
#include "experiments/study/question_answer.h"

namespace jnd::app::gui {
namespace {

using Kind = ItemView::Kind;

bool is_typed(Kind kind) {
  return kind == Kind::kNumber || kind == Kind::kText || kind == Kind::kWords;
}

std::string range_words(const ItemView& item) {
  std::string words;
  if (item.minimum && item.maximum) {
    words = tr("{} to {}", number_words(*item.minimum), number_words(*item.maximum));
  } else if (item.minimum) {
    words = tr("at least {}", number_words(*item.minimum));
  } else if (item.maximum) {
    words = tr("at most {}", number_words(*item.maximum));
  }
  if (item.unit.empty()) return words;
  return words.empty() ? tr("in {}", item.unit) : words + " " + item.unit;
}

/// True if a part between the commas is blank.
bool has_blank_word(std::string_view typed) {
  while (true) {
    const std::size_t comma = typed.find(',');
    if (is_blank(typed.substr(0, comma))) return true;
    if (comma == std::string_view::npos) return false;
    typed.remove_prefix(comma + 1);
  }
}

/// Why what is typed is no answer; "" if it is one.
std::string problem_with(const ItemView& item, const std::string& typed) {
  if (is_blank(typed)) return tr("type an answer first");
  if (item.kind == Kind::kWords) {
    const auto commas = std::count(typed.begin(), typed.end(), ',');
    if (commas + 1 != item.num_words || has_blank_word(typed)) {
      return tr("expected {} words, separated by commas", item.num_words);
    }
  }
  if (item.kind != Kind::kNumber) return "";
  const std::optional<double> value = typed_number(typed);
  if (!value) {
    return writes_decimal_comma() ? tr("expected a number, as 0,5 or 0.5")
                                  : tr("expected a number, with a point for decimals");
  }
  if ((item.minimum && !(*value >= *item.minimum)) ||
      (item.maximum && !(*value <= *item.maximum))) {
    return tr("expected {}", range_words(item));
  }
  return "";
}

class ItemCard {
 public:
  ItemCard(Ui& ui, const ItemView& item, RunViewState& state, RunViewResult& result)
      : ui_(ui), item_(item), state_(state), result_(result) {
    const std::string name = item.name + "/" + std::to_string(item.trial);
    if (state.item == name) return;
    state.item = name;
    state.typed = is_typed(item.kind) ? item.answer : "";
    state.says_yes = false;
    state.item_is_new = true;
    state.item_problem.clear();
    state.item_since_s = ui.time_s();
  }

  void add_controls(Stack& stack, float width) {
    switch (item_.kind) {
      case Kind::kTick:
        stack.add(72, 0, [this](const Rect& strip) { draw_tick(strip); });
        break;
      case Kind::kConsent:
        stack.add(72, 0, [this](const Rect& strip) { draw_consent(strip); });
        break;
      case Kind::kNumber:
      case Kind::kText:
      case Kind::kWords:
        add_typed(stack, width);
        break;
      case Kind::kYesNo:
        stack.add(72, 12, [this](const Rect& strip) { draw_yes_no(strip); });
        break;
      case Kind::kYesNoWhich:
        if (state_.says_yes) {
          add_typed(stack, width);
        } else {
          stack.add(72, 12, [this](const Rect& strip) { draw_yes_no(strip); });
        }
        break;
      case Kind::kChoice:
        add_choice(stack, width);
        break;
      case Kind::kScale:
        stack.add(104, 12, [this, width](const Rect& strip) { draw_steps(strip, width); });
        break;
    }
    if (item_.required || item_.kind == Kind::kTick || item_.kind == Kind::kConsent) return;
    stack.add(40, 0, [this](const Rect& strip) {
      draw_button_row(
          ui_, strip,
          {{"item_skip", tr("No answer"), {.tone = Tone::kQuiet, .key = {Key::kF6}}, [this] {
              give(experiments::kNoAnswer);
            }}});
    });
  }

 private:
  void give(const std::string& answer) {
    result_.requests.emplace_back(
        operate::AnswerItem{item_.stage, item_.name, answer, item_.trial});
    state_.item.clear();
  }

  /// An item can be ticked only after a moment, because nobody reads it in less time. So a key
  /// that is held or hammered on ticks nothing unread.
  void draw_tick(const Rect& strip) {
    constexpr double kLeastReading_s = 0.4;
    const bool is_read = ui_.time_s() - state_.item_since_s >= kLeastReading_s;
    draw_button_row(ui_, strip,
                    {{"item_done",
                      tr("Done"),
                      {.tone = Tone::kPrimary,
                       .key = {Key::kSpace},
                       .enabled = is_read,
                       .large = true,
                       .fresh = true},
                      [this] { give("done"); }}},
                    260);
  }

  void draw_consent(const Rect& strip) {
    draw_button_row(ui_, strip,
                    {{"consent_given",
                      tr("Consent is given"),
                      {.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true},
                      [this] { give("given"); }},
                     {"consent_refused",
                      tr("End without consent"),
                      {.key = {letter('E'), true}, .large = true},
                      [this] { open_dialog(state_, RunViewState::Dialog::kEndEarly); }}},
                    240);
  }

  void draw_yes_no(const Rect& strip) {
    draw_button_row(ui_, strip,
                    {{"item_yes",
                      tr("Yes"),
                      {.tone = Tone::kPrimary, .key = {letter('Y')}, .large = true},
                      [this] {
                        if (item_.kind == Kind::kYesNo) return give("yes");
                        state_.says_yes = true;
                        state_.item_is_new = true;
                      }},
                     {"item_no",
                      tr("No"),
                      {.tone = Tone::kPrimary, .key = {letter('N')}, .large = true},
                      [this] { give("no"); }}},
                    200);
  }

  void add_typed(Stack& stack, float width) {
    stack.add(52, 8, [this, width](const Rect& strip) {
      Rect row = strip.middle(std::min(width, 560.0f), 52);
      const ButtonStyle style{.tone = Tone::kPrimary, .key = {Key::kEnter}};
      const Rect button = row.take_right(ui_.button_width(tr("Store"), style), 12);
      const std::string hint = item_.kind == Kind::kWords        ? tr("word, word, word")
                               : item_.kind == Kind::kYesNoWhich ? tr("which?")
                                                                 : range_words(item_);
      const bool entered =
          ui_.text_field("item_text", row, state_.typed, hint, state_.item_is_new);
      // Below a dialog, even one that closes in this frame, the field cannot get the keyboard
      // yet.
      if (ui_.drawn().find("item_text")->enabled) state_.item_is_new = false;
      if (!ui_.button("item_store", button, tr("Store"), style) && !entered) return;
      state_.item_problem = problem_with(item_, state_.typed);
      if (!state_.item_problem.empty()) {
        // The field keeps the keyboard.
        state_.item_is_new = true;
        return;
      }
      give(item_.kind == Kind::kYesNoWhich ? as_is("yes: ") + state_.typed
           : item_.kind == Kind::kNumber   ? with_point(state_.typed)
                                           : state_.typed);
    });
    const std::string below =
        state_.item_problem.empty() ? range_words(item_) : state_.item_problem;
    stack.add_text(below, Font::kBody,
                   state_.item_problem.empty() ? Colour::kSoft : Colour::kAmber, width, 12);
  }

  void add_choice(Stack& stack, float width) {
    for (std::size_t i = 0; i < item_.options.size(); ++i) {
      stack.add(46, 8, [this, width, i](const Rect& strip) {
        const ItemView::Option& option = item_.options[i];
        ButtonStyle style;
        // The digits as they stand on a keyboard: 0 is the tenth.
        if (i < 10) style.key = {static_cast<Key>('0' + (i + 1) % 10)};
        const std::string name = "option_" + option.value;
        if (ui_.button(name, strip.middle(std::min(width, 460.0f), 46), option.label, style)) {
          give(option.value);
        }
      });
    }
  }

  void draw_steps(const Rect& strip, float width) {
    const int step = draw_scale(ui_, strip.middle(width, strip.height),
                                {.name = "scale_",
                                 .of = item_.name,
                                 .num_steps = item_.num_steps,
                                 .low_label = item_.low_label,
                                 .high_label = item_.high_label,
                                 .selected = std::atoi(item_.answer.c_str())},
                                state_.scale);
    if (step > 0) give(std::to_string(step));
  }

  Ui& ui_;
  const ItemView& item_;
  RunViewState& state_;
  RunViewResult& result_;
};

/// Draws the paragraphs of a consent and the sentence that is agreed to; a long text scrolls.
void draw_consent_text(Ui& ui, const Rect& place, const ItemView& item, RunViewState& state) {
  const Rect area = place.middle(std::min(820.0f, place.width - 48), place.height);
  Rect content = ui.begin_scroll("consent", area, state.consent_height);
  const float top = content.y;
  const TextStyle style{.wrap = true};
  for (const std::string& paragraph : item.paragraphs) {
    content.y += ui.text({content.x, content.y, area.width - 20, 4000}, paragraph, style) + 12;
  }
  content.y += ui.text({content.x, content.y, area.width - 20, 4000}, item.text,
                       {.font = Font::kStrong, .wrap = true}) +
               12;
  state.consent_height = content.y - top;
  ui.end_scroll();
}

/// Draws the answers to this questionnaire so far; a click on one asks its question again.
void draw_answered(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state) {
  Rect area = place.middle(std::min(820.0f, place.width - 48), place.height);
  ui.text(area.take_top(24), tr("Answered: choose one to change it"),
          {.font = Font::kSmall, .colour = Colour::kSoft});
  for (const ItemView& item : view.answered_items) {
    if (area.height < 32) break;
    Rect line = area.take_top(32);
    if (ui.row("change_" + item.name, line, item.text)) state.changed_item = item.name;
    line = line.middle(line.width - 12, line.height);
    Rect answer = line.take_right(line.width * 0.3f, 12);
    ui.text(line, item.text, {.colour = Colour::kSoft, .any_length = true});
    ui.text(answer, item.answer, {.align = Align::kRight, .any_length = true});
  }
}

/// Takes the digits that were typed; returns the step that they name so far, or 0.
int type_step(Ui& ui, const ScaleForm& form, ScaleTyping& typing) {
  if (typing.of != form.of) typing = {.of = form.of, .digits = ""};
  const std::size_t most_digits = std::to_string(form.num_steps).size();
  for (const char typed : ui.typed_digits()) {
    if (typed != '.' && typing.digits.size() < most_digits) typing.digits += typed;
  }
  if (!typing.digits.empty() && ui.typed_backspace()) typing.digits.pop_back();
  const int step = std::atoi(typing.digits.c_str());
  return step <= form.num_steps ? step : 0;
}

}  // namespace

int draw_scale(Ui& ui, const Rect& place, const ScaleForm& form, ScaleTyping& typing) {
  constexpr int kMostDigitKeys = 10;
  constexpr float kLeastButton = 30;
  int chosen = 0;
  Rect area = place;
  draw_name_and_value(ui, area.take_bottom(34), form.low_label,
                      {.colour = Colour::kSoft, .any_length = true}, form.high_label,
                      {.colour = Colour::kSoft, .any_length = true});
  const bool is_typed = form.num_steps > kMostDigitKeys;
  int selected = form.selected;
  if (is_typed) {
    const int typed = type_step(ui, form, typing);
    if (typed > 0) selected = typed;
    const std::string hint =
        typing.digits.empty() ? tr("type a number from 1 to {}, then Enter", form.num_steps)
        : typed > 0           ? tr("{}, Enter stores it", typed)
                    : tr("{} is no step: expected 1 to {}", typing.digits, form.num_steps);
    ui.text(area.take_bottom(24), hint,
            {.font = Font::kSmall,
             .colour = typing.digits.empty() || typed > 0 ? Colour::kSoft : Colour::kAmber,
             .align = Align::kCentre});
    if (typed > 0 && ui.pressed({Key::kEnter})) chosen = typed;
  }
  const float step = area.width / static_cast<float>(form.num_steps);
  if (step - 8 < kLeastButton && is_typed) {
    const Rect field = area.middle(std::min(220.0f, area.width), area.height - 8);
    ui.fill(field, Colour::kGround, 9);
    ui.outline(field, selected > 0 ? Colour::kBlue : Colour::kLine, 9, selected > 0 ? 2 : 1);
    ui.text(field.middle(field.width - 16, ui.line_height(Font::kLarge)),
            !typing.digits.empty() ? typing.digits
            : selected > 0         ? std::to_string(selected)
                                   : "",
            {.font = Font::kLarge, .align = Align::kCentre});
  } else {
    for (int i = 1; i <= form.num_steps; ++i) {
      const Rect box{area.x + step * static_cast<float>(i - 1) + 4, area.y, step - 8,
                     area.height - 8};
      const std::string number = std::to_string(i);
      const bool has_key = !is_typed && ui.pressed({static_cast<Key>('0' + i % 10)});
      if (ui.button(form.name + number, box, number, {.selected = i == selected}) || has_key) {
        chosen = i;
      }
    }
  }
  if (chosen > 0) typing.digits.clear();
  return chosen;
}

void draw_item_card(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state,
                    RunViewResult& result) {
  const ItemView* item = view.item ? &*view.item : nullptr;
  for (const ItemView& answered : view.answered_items) {
    if (answered.name == state.changed_item) item = &answered;
  }
  Rect inside = place.inset(14);
  const float width = std::min(760.0f, inside.width - 32);
  if (!view.answered_items.empty()) {
    const float wanted = 28 + 32 * static_cast<float>(view.answered_items.size());
    draw_answered(ui, inside.take_bottom(std::min(wanted, inside.height * 0.34f), 8), view,
                  state);
  }
  Stack stack(ui);
  if (item == nullptr) {
    stack.add_text(view.sentence, Font::kTitle, Colour::kInk, width, 22);
    stack.add(72, 0, [&](const Rect& strip) {
      draw_button_row(ui, strip,
                      {{"finish_stage",
                        tr("Go on"),
                        {.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true},
                        [&] {
                          result.requests.emplace_back(operate::FinishStage{view.stage, ""});
                        }}},
                      260);
    });
    stack.draw(inside);
    return;
  }
  if (item->kind == Kind::kConsent) {
    Rect controls = inside.take_bottom(86, 8);
    draw_consent_text(ui, inside, *item, state);
    ItemCard card(ui, *item, state, result);
    Stack buttons(ui);
    card.add_controls(buttons, width);
    buttons.draw(controls);
    return;
  }
  stack.add(18, 16,
            [&](const Rect& strip) { ui.heading(strip, view.heading, "", Align::kCentre); });
  const bool changing = item->name == state.changed_item;
  stack.add_text(changing ? item->text : view.sentence, Font::kTitle, Colour::kInk, width, 12);
  if (!changing) stack.add_text(in_quotes(view.say), Font::kLarge, Colour::kInk, width, 22);
  const std::size_t num_requests = result.requests.size();
  ItemCard card(ui, *item, state, result);
  card.add_controls(stack, width);
  stack.draw(inside);
  if (result.requests.size() > num_requests) state.changed_item.clear();
}

}  // namespace jnd::app::gui
