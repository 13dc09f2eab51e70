#include "app/gui/views/participant_view.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "app/gui/hand_sign.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

/// What can be answered by a control of theirs, and what that is called.
std::vector<std::pair<std::string, std::string>> answers_by_controls(const SessionView& view) {
  constexpr const char* kIntervals[] = {"first", "second", "third"};
  std::vector<std::pair<std::string, std::string>> answers;
  const auto add = [&](const std::string& label, std::initializer_list<const char*> actions) {
    for (const char* action : actions) {
      const auto control = view.controls.find(action);
      if (control == view.controls.end()) continue;
      answers.emplace_back(label, control->second);
      return;
    }
  };
  const TrialView& trial = *view.trial;
  if (trial.answer == experiments::AnswerKind::kYesNo) {
    add(trial.yes_label, {"yes", "first"});
    add(trial.no_label, {"no", "second"});
  }
  for (const TrialView::Choice& choice : trial.choices) {
    add(choice.label, {kIntervals[choice.interval - 1]});
  }
  if (trial.answer == experiments::AnswerKind::kMatch) add(tr("Matches"), {"matches"});
  if (trial.takes_cannot_tell) add(tr("Cannot tell"), {"cannot_tell"});
  return answers;
}

}  // namespace

void draw_participant_view(Ui& ui, const SessionView& view) {
  Rect screen = ui.screen();
  Rect foot = screen.take_bottom(48);
  ui.progress(foot.middle(foot.width * 0.6f, 10), view.done_ratio);
  Stack stack(ui);
  const float size = std::min(360.0f, screen.height * 0.45f);
  if (view.sign != HandSign::kNone) {
    stack.add(size, 48, [&](const Rect& strip) {
      draw_hand_sign(ui, strip.middle(size, size), view.sign);
    });
  }
  const bool answers = view.participant_answers && view.trial && view.trial->can_answer;
  stack.add_text(view.participant_text, Font::kHuge, Colour::kInk, screen.width * 0.8f,
                 answers ? 36 : 0);
  if (answers) {
    for (const auto& [label, control] : answers_by_controls(view)) {
      stack.add_text(tr("{}: press {}", label, control), Font::kLarge, Colour::kInk,
                     screen.width * 0.8f, 10);
    }
  }
  stack.draw(screen);
}

}  // namespace jnd::app::gui
