// The card of a trial: which fluid is felt, what to ask, and the answers.

#include <algorithm>
#include <optional>
#include <utility>

#include "app/gui/hand_sign.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using experiments::AnswerKind;
using experiments::Direction;
using experiments::StepSize;

constexpr float kAnswerButton = 84;
constexpr float kSmallButton = 46;

/// An interval of a trial: its name in requests, and the labels of its buttons.
struct Interval {
  const char *name, *present, *again, *back, *button;
  Key key;
};
constexpr Interval kTest = {"test",
                            tr_later("Present the test"),
                            tr_later("Test again"),
                            tr_later("Back to the test"),
                            "present_test",
                            letter('T')};
constexpr Interval kReference = {"reference",
                                 tr_later("Present the reference"),
                                 tr_later("Reference again"),
                                 tr_later("Back to the reference"),
                                 "present_reference",
                                 letter('R')};
constexpr Interval kFirst = {"first",
                             tr_later("Present the first"),
                             tr_later("First again"),
                             tr_later("Back to the first"),
                             "present_first",
                             Key::kLeft};
constexpr Interval kSecond = {"second",
                              tr_later("Present the second"),
                              tr_later("Second again"),
                              tr_later("Back to the second"),
                              "present_second",
                              Key::kRight};
constexpr Interval kThird = {"third",
                             tr_later("Present the third"),
                             tr_later("Third again"),
                             tr_later("Back to the third"),
                             "present_third",
                             Key::kDown};

/// The interval with this name.
const Interval& interval_named(const std::string& name) {
  return name == kFirst.name ? kFirst : name == kSecond.name ? kSecond : kThird;
}

/// The interval that is felt first.
const Interval& first_of(const TrialView& trial) {
  return trial.order_is_drawn ? kFirst : trial.has_reference ? kReference : kTest;
}
const Interval& last_of(const TrialView& trial) {
  if (!trial.order_is_drawn) return kTest;
  return trial.num_intervals == 2 ? kSecond : kThird;
}

std::string felt_before(const TrialView& trial, double felt_s) {
  if (trial.order_is_drawn) return tr("first felt before for {:.1f} s", felt_s);
  return trial.has_reference ? tr("reference felt before for {:.1f} s", felt_s)
                             : tr("test felt before for {:.1f} s", felt_s);
}

std::string felt_words(const TrialView& trial) {
  std::string words;
  if (!trial.interval.empty()) {
    words = trial.stimulus_is_over ? tr("it ended after {:.1f} s", trial.felt_s)
                                   : tr("felt for {:.1f} s", trial.felt_s);
    if (trial.least_left_s > 0.0) words += " · " + tr("{:.1f} s to go", trial.least_left_s);
    if (trial.num_strokes > 0) {
      words += " · " + trn("{} stroke", "{} strokes", trial.num_strokes);
    }
    if (trial.interval != first_of(trial).name && trial.first_felt_s) {
      words += " · " + felt_before(trial, *trial.first_felt_s);
    }
  }
  if (trial.deadline_left_s) {
    words += " · " + tr("{:.1f} s left to answer", std::max(0.0, *trial.deadline_left_s));
  }
  if (!trial.level.empty()) words += (words.empty() ? "" : " · ") + trial.level;
  return words;
}

bool is_typed(AnswerKind kind) {
  return kind == AnswerKind::kPercent || kind == AnswerKind::kNumber;
}

/// Takes digits and one point, for a percentage or another number.
void type_number(Ui& ui, const TrialView& trial, RunViewState& state) {
  // When an attempt is undone or broken off, what was typed for it is dropped.
  if (state.percent_trial != trial.trial || state.percent_attempt != trial.attempt) {
    state.percent_trial = trial.trial;
    state.percent_attempt = trial.attempt;
    state.percent.clear();
  }
  for (const char typed : ui.typed_digits()) {
    constexpr std::size_t kMostDigits = 7;
    if (state.percent.size() >= kMostDigits) break;
    if (typed == '.' && state.percent.find('.') != std::string::npos) continue;
    state.percent += typed;
  }
  if (ui.typed_backspace() && !state.percent.empty()) state.percent.pop_back();
}

class TrialCard {
 public:
  /// `width` is the card's width.
  TrialCard(Ui& ui, float width, const SessionView& view, RunViewState& state,
            RunViewResult& result)
      : ui_(ui),
        width_(width),
        view_(view),
        trial_(*view.trial),
        state_(state),
        result_(result) {}

  void add_controls(Stack& stack) {
    if (view_.step != Step::kPresenting) {
      stack.add(kAnswerButton, 18, [this](const Rect& place) { draw_first(place); });
      return;
    }
    const bool test = trial_.interval == "test";
    if (trial_.answer == AnswerKind::kYesNo && trial_.can_answer) {
      stack.add(kAnswerButton, 18, [this](const Rect& place) { draw_yes_no(place); });
    } else if (trial_.answer == AnswerKind::kInterval && trial_.can_answer) {
      stack.add(kAnswerButton, 18, [this](const Rect& place) { draw_choice(place); });
    } else if (trial_.answer == AnswerKind::kStep && trial_.can_answer) {
      stack.add(104, 12, [this](const Rect& place) {
        const Rect scale = place.middle(std::min(760.0f, place.width - 32), place.height);
        const int step = draw_scale(
            ui_, scale,
            {.name = "step_",
             .of = std::to_string(trial_.trial) + "/" + std::to_string(trial_.attempt),
             .num_steps = trial_.num_steps,
             .low_label = trial_.low_label,
             .high_label = trial_.high_label},
            state_.scale);
        if (step > 0) answer(step);
      });
    } else if (is_typed(trial_.answer) && trial_.can_answer) {
      type_number(ui_, trial_, state_);
      stack.add(kAnswerButton, 18, [this](const Rect& place) { draw_number(place); });
    } else if (trial_.answer == AnswerKind::kMatch && test) {
      add_steps(stack);
    } else {
      stack.add(kAnswerButton, 18, [this](const Rect& place) { draw_next(place); });
    }
    stack.add(kSmallButton, 0, [this](const Rect& place) { draw_switches(place); });
  }

 private:
  /// True if the present stimulus has been felt for as long as the study asks.
  [[nodiscard]] bool may_go_on() const noexcept { return trial_.least_left_s <= 0.0; }
  /// The pedal or button for this action; "" if none is mapped.
  [[nodiscard]] std::string_view control_of(const std::string& action) const {
    const auto found = view_.controls.find(action);
    return found == view_.controls.end() ? std::string_view() : found->second;
  }
  /// The control for either of two actions, whichever is mapped.
  [[nodiscard]] std::string_view control_of(const std::string& action,
                                            const std::string& other) const {
    const std::string_view found = control_of(action);
    return found.empty() ? control_of(other) : found;
  }
  /// The answers stand out if the experimenter gives them.
  [[nodiscard]] Tone answer_tone() const noexcept {
    return view_.participant_answers ? Tone::kPlain : Tone::kPrimary;
  }
  void present(const char* interval) {
    result_.requests.emplace_back(operate::Present{trial_.trial, interval});
  }
  void answer(std::optional<double> value) {
    result_.requests.emplace_back(operate::Answer{trial_.trial, value});
  }

  void draw_first(const Rect& place) {
    const Interval& first = first_of(trial_);
    draw_button_row(ui_, place,
                    {{"present",
                      trial_.has_reference ? tr(first.present)
                      : trial_.is_solid    ? tr("Present the surface")
                                           : tr("Present the fluid"),
                      {.tone = Tone::kPrimary,
                       .key = {Key::kSpace},
                       .large = true,
                       .note = control_of("present")},
                      [&] { present(first.name); }}},
                    320);
    // The key that the interval has in other places works as well.
    if (ui_.pressed({first.key})) present(first.name);
  }

  void draw_next(const Rect& place) {
    const bool to_first =
        trial_.interval == "free_space" && trial_.has_reference && !trial_.first_felt_s;
    const bool is_in_order = trial_.order_is_drawn && !trial_.next_interval.empty();
    const Interval& next = is_in_order ? interval_named(trial_.next_interval)
                           : to_first  ? first_of(trial_)
                                       : last_of(trial_);
    draw_button_row(ui_, place,
                    {{"present",
                      tr(next.present),
                      {.tone = Tone::kPrimary,
                       .key = {Key::kSpace},
                       .enabled = may_go_on(),
                       .large = true,
                       .note = control_of("present")},
                      [&] { present(next.name); }}},
                    320);
    // The key that the interval has everywhere else works as well.
    if (!to_first && may_go_on() && ui_.pressed({next.key})) present(next.name);
  }

  void draw_yes_no(const Rect& place) {
    draw_answers(place, {{"answer_yes",
                          trial_.yes_label,
                          {.tone = answer_tone(),
                           .key = {letter('Y')},
                           .enabled = may_go_on(),
                           .large = true,
                           .note = control_of("yes", "first")},
                          [&] { answer(1.0); }},
                         {"answer_no",
                          trial_.no_label,
                          {.tone = answer_tone(),
                           .key = {letter('N')},
                           .enabled = may_go_on(),
                           .large = true,
                           .note = control_of("no", "second")},
                          [&] { answer(0.0); }}});
  }

  /// Draws the answers of a choice, followed by "cannot tell" if that is an answer.
  void draw_answers(const Rect& place, std::vector<RowButton> buttons) {
    if (trial_.takes_cannot_tell) {
      buttons.push_back({"answer_cannot_tell",
                         tr("Cannot tell"),
                         {.key = {letter('C')},
                          .enabled = may_go_on(),
                          .large = true,
                          .note = control_of("cannot_tell")},
                         [this] { answer(std::nullopt); }});
    }
    const auto count = static_cast<float>(buttons.size());
    draw_button_row(ui_, place, buttons, std::min(250.0f, (place.width - 40) / count));
  }

  void draw_choice(const Rect& place) {
    constexpr const char* kNames[] = {"answer_first", "answer_second", "answer_third"};
    constexpr const char* kActions[] = {"first", "second", "third"};
    std::vector<RowButton> buttons;
    for (const TrialView::Choice& choice : trial_.choices) {
      const auto number = static_cast<char>('0' + choice.interval);
      buttons.push_back({kNames[choice.interval - 1],
                         choice.label.c_str(),
                         {.tone = answer_tone(),
                          .key = {letter(number)},
                          .enabled = may_go_on(),
                          .large = true,
                          .note = control_of(kActions[choice.interval - 1])},
                         [this, interval = choice.interval] { answer(interval); }});
    }
    draw_answers(place, std::move(buttons));
  }

  void draw_number(const Rect& place) {
    const bool percent = trial_.answer == AnswerKind::kPercent;
    Rect row = place.middle(std::min(520.0f, place.width - 32), place.height);
    const bool typed = !state_.percent.empty() && state_.percent != ".";
    const double number = std::strtod(state_.percent.c_str(), nullptr);
    const bool is_answer = typed && (percent || number > 0.0) && may_go_on();
    const Rect enter = row.take_right(std::min(200.0f, row.width * 0.42f), 16);
    ui_.fill(row, Colour::kGround, 9);
    ui_.outline(row, typed ? Colour::kBlue : Colour::kLine, 9, typed ? 2 : 1);
    const TextStyle style{.font = typed ? Font::kHuge : Font::kLarge,
                          .colour = typed ? Colour::kInk : Colour::kSoft,
                          .align = Align::kCentre};
    ui_.text(row.middle(row.width - 20, ui_.line_height(style.font)),
             !typed    ? percent ? tr("type the percent") : tr("type a number above 0")
                : percent ? state_.percent + " %"
                       : state_.percent,
             style);
    if (ui_.button("answer_percent", enter, tr("Store"),
                   {.tone = Tone::kPrimary,
                    .key = {Key::kEnter},
                    .enabled = is_answer,
                    .large = true})) {
      answer(number);
      state_.percent.clear();
    }
  }

  RowButton step_button(const char* name, const char* label, Key key, Direction direction,
                        StepSize size) {
    const bool is_fine = size == StepSize::kFine;
    const char* action = direction == Direction::kLower ? (is_fine ? "lower_fine" : "lower")
                                                        : (is_fine ? "raise_fine" : "raise");
    return {name,
            label,
            {.key = {key}, .enabled = may_go_on(), .repeats = true, .note = control_of(action)},
            [this, direction, size] {
              result_.requests.emplace_back(
                  operate::Adjust{trial_.trial, direction, size, ui_.was_held()});
            }};
  }

  /// Adds the steps in one row with "Matches" in the middle; on a narrow card, "Matches" is
  /// below.
  void add_steps(Stack& stack) {
    const RowButton matches{"matches",
                            tr("Matches"),
                            {.tone = answer_tone(),
                             .key = {Key::kEnter},
                             .enabled = may_go_on(),
                             .large = true,
                             .note = control_of("matches")},
                            [this] { answer(0.0); }};
    std::vector<RowButton> steps = {step_button("lower_coarse", tr("Lower"), Key::kLeft,
                                                Direction::kLower, StepSize::kCoarse),
                                    step_button("lower_fine", tr("A bit lower"), Key::kDown,
                                                Direction::kLower, StepSize::kFine),
                                    step_button("raise_fine", tr("A bit higher"), Key::kUp,
                                                Direction::kRaise, StepSize::kFine),
                                    step_button("raise_coarse", tr("Raise"), Key::kRight,
                                                Direction::kRaise, StepSize::kCoarse)};
    constexpr float kWide = 800;
    if (width_ >= kWide) {
      steps.insert(steps.begin() + 2, matches);
      stack.add(kAnswerButton, 14, [this, steps](const Rect& place) {
        draw_button_row(ui_, place, steps, std::min(150.0f, (place.width - 90) / 5));
      });
      return;
    }
    stack.add(kAnswerButton - 26, 10, [this, matches](const Rect& place) {
      draw_button_row(ui_, place, {matches}, 260);
    });
    stack.add(kSmallButton, 10,
              [this, steps](const Rect& place) { draw_button_row(ui_, place, steps, 110); });
  }

  void draw_switches(const Rect& place) {
    std::vector<RowButton> buttons;
    const Interval& first = first_of(trial_);
    const Interval& last = last_of(trial_);
    const auto add = [&](const Interval& interval) {
      if (std::ranges::find(trial_.closed_intervals, interval.name) !=
          trial_.closed_intervals.end()) {
        return;
      }
      const bool again = trial_.interval == interval.name || trial_.interval == first.name;
      buttons.push_back({interval.button,
                         again ? tr(interval.again) : tr(interval.back),
                         {.key = {interval.key}, .enabled = may_go_on()},
                         [this, &interval] { present(interval.name); }});
    };
    if (trial_.has_reference) add(first);
    const bool has_three = trial_.order_is_drawn && trial_.num_intervals > 2;
    if (has_three && trial_.next_interval != kSecond.name) add(kSecond);
    const bool offers_last =
        has_three ? trial_.can_answer
                  : !trial_.has_reference || trial_.interval != first.name || trial_.can_answer;
    if (offers_last) add(last);
    if (trial_.interval != "free_space") {
      buttons.push_back({"present_free_space",
                         tr("Free space"),
                         {.key = {letter('F')}, .enabled = may_go_on()},
                         [this] { present("free_space"); }});
    }
    draw_button_row(ui_, place, buttons);
  }

  Ui& ui_;
  float width_;
  const SessionView& view_;
  const TrialView& trial_;
  RunViewState& state_;
  RunViewResult& result_;
};

}  // namespace

void draw_trial_card(Ui& ui, const Rect& place, const SessionView& view,
                     const std::vector<TracePoint>& trace, RunViewState& state,
                     RunViewResult& result) {
  const float words_width = std::min(720.0f, place.width - 48);
  const bool roomy = place.height > 460;
  Rect card = place.inset(12);
  Stack stack(ui);
  if (!view.is_alone) {
    stack.add(18, roomy ? 18 : 8, [&ui, &view](const Rect& strip) {
      ui.heading(strip, view.heading, "", Align::kCentre);
    });
    if (view.sign != HandSign::kNone && place.height > 320) {
      const float size = roomy ? 140.0f : 60.0f;
      stack.add(size, roomy ? 20 : 8, [&ui, &view, size](const Rect& strip) {
        draw_hand_sign(ui, strip.middle(size, size), view.sign);
      });
    }
  }
  const Font large = view.is_alone || !roomy ? Font::kLarge : Font::kTitle;
  stack.add_text(view.sentence, large, Colour::kInk, words_width, 6);
  stack.add_text(in_quotes(view.say), large, Colour::kInk, words_width, 10);
  stack.add_text(felt_words(*view.trial), Font::kBody, Colour::kSoft, words_width,
                 roomy ? 24 : 12);
  TrialCard controls(ui, place.width, view, state, result);
  controls.add_controls(stack);
  if (view.is_alone) {
    const Rect pad = card.take_top(pad_height(card, stack.height()), 14);
    draw_pad(ui, pad, view, trace, state);
  }
  stack.draw(card);
}

}  // namespace jnd::app::gui
