// The card in the middle while no trial is under way.

#include <algorithm>
#include <array>
#include <cmath>

#include "app/gui/hand_sign.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kLargeButton = 72;

void add_heading(Ui& ui, Stack& stack, const SessionView& view) {
  stack.add(18, 18, [&ui, heading = view.heading](const Rect& strip) {
    ui.heading(strip, heading, "", Align::kCentre);
  });
}

void add_words(Stack& stack, const SessionView& view, const Rect& place) {
  const float width = std::min(720.0f, place.width - 48);
  stack.add_text(view.sentence, Font::kTitle, Colour::kInk, width, view.say.empty() ? 30 : 14);
  stack.add_text(in_quotes(view.say), Font::kLarge, Colour::kInk, width, 30);
}

void draw_begin(Ui& ui, const Rect& place, const SessionView& view, RunViewResult& result) {
  Stack stack(ui);
  add_heading(ui, stack, view);
  add_words(stack, view, place);
  const auto begin = [&](const char* choice) {
    result.requests.emplace_back(operate::Begin{choice});
  };
  if (view.last_sequence == 0) {
    stack.add(kLargeButton, 0, [&](const Rect& strip) {
      draw_button_row(ui, strip,
                      {{"begin",
                        tr("Begin the session"),
                        {.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true},
                        [&] { begin("repeat"); }}},
                      300);
    });
  } else {
    stack.add_text(tr("{} answers are safe on disk. Nothing that was answered is asked again, "
                      "unless you restart the block.",
                      view.trials_on_disk),
                   Font::kBody, Colour::kSoft, std::min(640.0f, place.width - 48), 24);
    stack.add(kLargeButton, 16, [&](const Rect& strip) {
      draw_button_row(ui, strip,
                      {{"resume_repeat",
                        tr("Repeat the interrupted trial"),
                        {.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true},
                        [&] { begin("repeat"); }}},
                      360);
    });
    stack.add(46, 0, [&](const Rect& strip) {
      draw_button_row(
          ui, strip,
          {{"resume_restart",
            tr("Restart the block"),
            {.key = {letter('B')}},
            [&] { begin("restart"); }},
           {"resume_end", tr("End the session here"), {.key = {letter('E'), true}}, [&] {
              begin("end");
            }}});
    });
  }
  stack.draw(place);
}

void draw_medium(Ui& ui, const Rect& place, const SessionView& view,
                 const std::vector<TracePoint>& trace, RunViewState& state,
                 RunViewResult& result) {
  Stack stack(ui);
  const bool feeling = view.step == Step::kFeeling;
  if (!view.is_alone) {
    add_heading(ui, stack, view);
    if (place.height > 420) {
      stack.add(120, 18, [&](const Rect& strip) {
        draw_hand_sign(ui, strip.middle(120, 120), view.sign);
      });
    }
  }
  const float width = std::min(720.0f, place.width - 48);
  stack.add_text(view.sentence, view.is_alone ? Font::kLarge : Font::kTitle, Colour::kInk,
                 width, 10);
  stack.add_text(in_quotes(view.say), Font::kLarge, Colour::kInk, width, 16);
  if (feeling && view.medium && view.medium->duration_s > 0) {
    stack.add(8, 20, [&](const Rect& strip) {
      ui.progress(strip.middle(std::min(420.0f, strip.width - 48), 8),
                  view.medium->felt_s / view.medium->duration_s);
    });
  }
  stack.add(kLargeButton, 0, [&](const Rect& strip) {
    const bool over = feeling && view.medium && view.medium->felt_s >= view.medium->duration_s;
    draw_button_row(ui, strip,
                    {{feeling ? "finish_medium" : "feel_medium",
                      feeling ? tr("Go on") : tr("Present it"),
                      {.tone = !feeling || over ? Tone::kPrimary : Tone::kPlain,
                       .key = {Key::kSpace},
                       .large = true},
                      [&] {
                        if (feeling) {
                          result.requests.emplace_back(operate::FinishMedium{});
                        } else {
                          result.requests.emplace_back(operate::FeelMedium{});
                        }
                      }}},
                    260);
  });
  Rect card = place.inset(12);
  if (view.is_alone) {
    const Rect pad = card.take_top(pad_height(card, stack.height()), 14);
    draw_pad(ui, pad, view, trace, state);
  }
  stack.draw(card);
}

void draw_break(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state,
                RunViewResult& result) {
  Stack stack(ui);
  add_heading(ui, stack, view);
  const bool over = view.break_left_s <= 0.0;
  using Dialog = RunViewState::Dialog;
  if (over && state.dialog == Dialog::kGoOnEarly) state.dialog = Dialog::kNone;
  stack.add_text(over ? "0:00" : clock_words(std::ceil(view.break_left_s)), Font::kHuge,
                 over ? Colour::kGreen : Colour::kInk, place.width, 12);
  add_words(stack, view, place);
  stack.add(kLargeButton, 0, [&](const Rect& strip) {
    draw_button_row(
        ui, strip,
        {{"finish_break",
          over ? tr("Go on") : tr("Go on early"),
          {.tone = over ? Tone::kPrimary : Tone::kPlain, .key = {Key::kEnter}, .large = true},
          [&] {
            if (over) {
              result.requests.emplace_back(operate::FinishStage{view.stage, ""});
            } else {
              open_dialog(state, Dialog::kGoOnEarly);
            }
          }}},
        260);
  });
  stack.draw(place);
}

/// Draws one sentence and one button.
void draw_simple(Ui& ui, const Rect& place, const SessionView& view, const RowButton& button) {
  Stack stack(ui);
  add_heading(ui, stack, view);
  if (view.sign != HandSign::kNone) {
    stack.add(120, 18, [&](const Rect& strip) {
      draw_hand_sign(ui, strip.middle(120, 120), view.sign);
    });
  }
  add_words(stack, view, place);
  stack.add(kLargeButton, 0,
            [&](const Rect& strip) { draw_button_row(ui, strip, {button}, 260); });
  stack.draw(place);
}

/// The button that brings the force back. The stop is released first, by an act of its own.
RowButton arming_button(const SessionView& view, RunViewResult& result) {
  const ButtonStyle style{.tone = Tone::kPrimary, .key = {Key::kEnter, true}, .large = true};
  if (view.stop_pressed) {
    return {"release_stop", tr("Release the stop"), style,
            [&] { result.requests.emplace_back(operate::ReleaseStop{view.num_stop_presses}); }};
  }
  ButtonStyle arming = style;
  // Two clicks meant as one must not release the stop and arm.
  arming.enabled = view.telemetry.arming_wait_s == 0.0;
  return {"rearm", view.is_disarmed ? tr("Arm the device") : tr("Arm again"), arming,
          [&] { result.requests.emplace_back(operate::Rearm{view.telemetry.num_faults}); }};
}

/// Draws the card of a device that nobody has armed yet, which is no fault.
void draw_disarmed(Ui& ui, const Rect& place, const SessionView& view, RunViewResult& result) {
  ui.outline(place, Colour::kAmber, 10, 3);
  Stack stack(ui);
  const bool roomy = place.height > 420;
  const float width = std::min(720.0f, place.width - 48);
  stack.add_text(tr("Disarmed"), roomy ? Font::kHuge : Font::kTitle, Colour::kInk,
                 place.width - 48, 16);
  stack.add_text(view.sentence, Font::kLarge, Colour::kInk, width, 24);
  stack.add(kLargeButton, 0, [&](const Rect& strip) {
    draw_button_row(ui, strip, {arming_button(view, result)}, 360);
  });
  stack.draw(place.inset(10));
}

void draw_fault(Ui& ui, const Rect& place, const SessionView& view, RunViewResult& result) {
  if (view.is_disarmed && !view.stop_pressed) return draw_disarmed(ui, place, view, result);
  Rect inside = place;
  ui.outline(place, Colour::kRed, 10, 3);
  Stack stack(ui);
  const bool roomy = inside.height > 420;
  stack.add_text(view.heading, roomy ? Font::kHuge : Font::kTitle, Colour::kRed,
                 inside.width - 48, 16);
  const float width = std::min(720.0f, inside.width - 48);
  stack.add_text(tr("The force is off and stays off."), roomy ? Font::kTitle : Font::kLarge,
                 Colour::kInk, width, 12);
  stack.add_text(view.sentence, Font::kLarge, Colour::kInk, width, 12);
  stack.add_text(
      tr("Every answer up to trial {} is on disk. The trial under way will be run again.",
         view.trials_on_disk),
      Font::kBody, Colour::kSoft, width, 24);
  stack.add(kLargeButton, 0, [&](const Rect& strip) {
    draw_button_row(ui, strip, {arming_button(view, result)}, 360);
  });
  stack.draw(inside.inset(10));
}

/// Draws the points of the hand that need attention before something is felt.
void draw_points(Ui& ui, Rect& card, const SessionView& view, RunViewState& state) {
  const bool is_loose = !view.loose_points.empty();
  if (!is_loose && view.absent_points.empty()) return;
  constexpr std::array kBeforeSomethingIsFelt = {Step::kBegin, Step::kPaused, Step::kMedium,
                                                 Step::kRest, Step::kReady};
  if (std::ranges::find(kBeforeSomethingIsFelt, view.step) == kBeforeSomethingIsFelt.end()) {
    return;
  }
  Rect strip = card.take_bottom(56);
  strip = strip.middle(strip.width - 32, 44);
  if (is_loose) {
    const ButtonStyle style{.key = {letter('G'), true}};
    const char* label = tr("Go on without it");
    const Rect button = strip.take_right(ui.button_width(label, style), 12);
    if (ui.button("go_on_without", button, label, style)) {
      open_dialog(state, RunViewState::Dialog::kGoOnWithout);
      state.given_up_bits = view.loose_bits;
    }
  }
  ui.text(strip,
          is_loose ? tr("Came off: {}.", view.loose_points)
                   : tr("Not on the hand: {}.", view.absent_points),
          {.colour = Colour::kAmber, .align = Align::kCentre});
}

}  // namespace

void draw_run_card(Ui& ui, const Rect& place, const SessionView& view,
                   const std::vector<TracePoint>& trace, AfterSession& after,
                   RunViewState& state, RunViewResult& result) {
  ui.card(place);
  Rect inside = place;
  // Draws words at the bottom of the card, as high as they need.
  const auto say = [&](const std::string& words, Font font) {
    const TextStyle amber{
        .font = font, .colour = Colour::kAmber, .align = Align::kCentre, .wrap = true};
    const float height = ui.text_height(inside.width - 32, words, amber) + 16;
    Rect strip = inside.take_bottom(height);
    strip = strip.middle(strip.width - 32, height - 16);
    ui.text(strip, words, amber);
  };
  if (!view.refusal.empty()) say(tr("Not done: {}.", view.refusal), Font::kBody);
  const bool may_rest = view.step == Step::kReady || view.step == Step::kRest ||
                        view.step == Step::kStageDone || view.step == Step::kItem;
  if (!view.advice.empty() && may_rest) {
    say(tr("The study's limit is passed: {}.", view.advice), Font::kBody);
  }
  if (!view.sound_warning.empty()) {
    say(tr("Sound: {}.", view.sound_warning), Font::kSmall);
  }
  if (!view.caution.empty() && view.step == Step::kStageDone) {
    say(tr("Caution: {}.", view.caution), Font::kSmall);
  }
  if (!view.remark.empty() && view.step == Step::kBegin) say(view.remark, Font::kSmall);
  draw_points(ui, inside, view, state);
  switch (view.step) {
    case Step::kBegin:
      return draw_begin(ui, inside, view, result);
    case Step::kItem:
      return draw_item_card(ui, inside, view, state, result);
    case Step::kMedium:
    case Step::kFeeling:
      if (view.item && view.step == Step::kFeeling) {
        return draw_item_card(ui, inside, view, state, result);
      }
      return draw_medium(ui, inside, view, trace, state, result);
    case Step::kBreak:
      return draw_break(ui, inside, view, state, result);
    case Step::kRest:
    case Step::kReady:
    case Step::kPresenting:
      return draw_trial_card(ui, inside, view, trace, state, result);
    case Step::kStageDone:
      if (!view.answered_items.empty()) {
        return draw_item_card(ui, inside, view, state, result);
      }
      return draw_simple(ui, inside, view,
                         {"finish_stage",
                          tr("Go on"),
                          {.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true},
                          [&] {
                            result.requests.emplace_back(operate::FinishStage{view.stage, ""});
                          }});
    case Step::kPaused:
      return draw_simple(ui, inside, view,
                         {"go_on",
                          tr("Go on"),
                          {.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true},
                          [&] { result.requests.emplace_back(operate::GoOn{}); }});
    case Step::kFault:
      return draw_fault(ui, inside, view, result);
    case Step::kFailed:
      ui.outline(place, Colour::kRed, 10, 3);
      return draw_simple(ui, inside, view,
                         {"leave_failed",
                          tr("Leave the session"),
                          {.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true},
                          [&] {
                            result.requests.emplace_back(operate::Leave{});
                            result.to_sessions = true;
                          }});
    case Step::kFinished:
      return draw_after_card(ui, inside, view, after, state, result);
  }
}

void draw_after_card(Ui& ui, const Rect& place, const SessionView& view, AfterSession& after,
                     RunViewState& /*state*/, RunViewResult& result) {
  Stack stack(ui);
  const float width = std::min(640.0f, place.width - 48);
  stack.add_text(tr("Session finished"), Font::kTitle, Colour::kInk, width, 8);
  stack.add_text(tr("{} answers of {} are on disk.", view.trials_on_disk, view.participant),
                 Font::kLarge, Colour::kInk, width, 22);
  const auto outcome = [&](const char* what, bool running, const std::string& sentence,
                           bool failed, bool has_caution) {
    const std::string words = sentence.empty() || running ? what : sentence;
    const TextStyle style{.colour = sentence.empty() || running ? Colour::kSoft : Colour::kInk,
                          .wrap = true};
    const float height = ui.text_height(width - 22, words, style);
    stack.add(height, 10,
              [&ui, &after, width, words, style, running, failed, has_caution, height,
               told = !sentence.empty()](const Rect& strip) {
                Rect line = strip.middle(width, height);
                ui.dot(line.x + 6, line.y + 11, 5,
                       running       ? Colour::kBlue
                       : !told       ? Colour::kLine
                       : failed      ? Colour::kRed
                       : has_caution ? Colour::kAmber
                                     : Colour::kGreen);
                line.take_left(22);
                ui.text(line, words, style);
                if (running) {
                  ui.progress({line.right() - 160, line.y + 9, 160, 8}, after.progress);
                }
              });
  };
  outcome(tr("Checking that everything is on disk …"), after.checking, after.check,
          after.check_failed, false);
  outcome(after.backing_up ? tr("Copying …") : tr("Not backed up yet."), after.backing_up,
          after.backup, after.backup_failed, after.backup_has_caution);
  stack.add(46, 26, [&](const Rect& strip) {
    Rect line = strip.middle(width, 46);
    const ButtonStyle style{.key = {letter('B'), true},
                            .enabled = !after.backing_up && !after.backup_folder.empty()};
    const Rect button = line.take_right(ui.button_width(tr("Back up"), style), 12);
    (void)ui.text_field("backup_folder", line, after.backup_folder, tr("folder for the copy"));
    if (ui.button("back_up", button, tr("Back up"), style)) result.back_up = true;
  });
  stack.add(72, 0, [&](const Rect& strip) {
    draw_button_row(
        ui, strip,
        {{"to_sessions",
          view.is_alone ? tr("Back to the study") : tr("Next participant"),
          {.tone = Tone::kPrimary, .key = {Key::kEnter, true}, .large = true},
          [&] { result.to_sessions = true; }},
         {"to_results",
          tr("See the results"),
          {.key = {letter('R'), true}, .enabled = !view.hides_levels, .large = true},
          [&] { result.to_results = true; }}},
        240);
  });
  stack.draw(place);
}

}  // namespace jnd::app::gui
