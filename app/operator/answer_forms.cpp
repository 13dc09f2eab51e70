#include "app/operator/answer_forms.h"

#include <tuple>

#include "app/language/words.h"
#include "app/operator/session_words.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/rating.h"
#include "experiments/procedures/task.h"
#include "experiments/study/media.h"

namespace jnd::app {

using namespace experiments;

std::string AnswerForms::words(const Text& text) const {
  if (text.empty()) return "";
  const auto chosen = text.find(language);
  if (chosen != text.end()) return chosen->second;
  const auto first = text.find(study.languages.front());
  return first != text.end() ? first->second : text.begin()->second;
}

std::pair<std::string, std::string> AnswerForms::labels_of(const Block& block) const {
  const auto label = [&](const Text& text, const char* otherwise) {
    return text.empty() ? otherwise : words(text);
  };
  switch (task_of(block)) {
    case Task::kTwoInterval:
      return {label(block.first_label, tr("First")), label(block.second_label, tr("Second"))};
    case Task::kSameDifferent:
      return {label(block.yes_label, tr("Different")), label(block.no_label, tr("Same"))};
    case Task::kReminder:
    case Task::kYesNo:
    case Task::kThreeInterval:
    case Task::kOddity:
    case Task::kAbx:
    case Task::kMatchToSample:
      break;
  }
  return {label(block.yes_label, tr("Yes")), label(block.no_label, tr("No"))};
}

std::vector<TrialView::Choice> AnswerForms::choices_of(const Block& block,
                                                       const TrialForm& form) const {
  const std::pair<const Text&, const char*> kNames[] = {{block.first_label, tr("First")},
                                                        {block.second_label, tr("Second")},
                                                        {block.third_label, tr("Third")}};
  std::vector<TrialView::Choice> choices;
  for (int i = form.first_choice; i < form.first_choice + form.num_choices; ++i) {
    const auto& [written, otherwise] = kNames[i - 1];
    choices.push_back({i, written.empty() ? std::string(otherwise) : words(written)});
  }
  return choices;
}

AnswerForm AnswerForms::form_of(const Block& block) const {
  const TrialForm form = procedure_named(block.procedure).form(block);
  AnswerForm of{.kind = form.answer, .takes_cannot_tell = block.cannot_tell};
  std::tie(of.yes_label, of.no_label) = labels_of(block);
  if (form.answer == AnswerKind::kInterval) of.choices = choices_of(block, form);
  if (form.answer == AnswerKind::kStep) {
    of.num_steps = num_steps_of(block);
    of.low_label = words(block.low_label);
    of.high_label = words(block.high_label);
  }
  if (form.answer == AnswerKind::kMatch) {
    of.is_hidden = hides_intensity;
    of.unit = quantity_unit(block.quantity);
  }
  return of;
}

std::string AnswerForms::in_words(const Block& block,
                                  const std::optional<double>& given) const {
  if (!given) return tr("cannot tell");
  const double answer = *given;
  const TrialForm form = procedure_named(block.procedure).form(block);
  const AnswerKind kind = form.answer;
  if (kind == AnswerKind::kInterval) {
    for (const TrialView::Choice& choice : choices_of(block, form)) {
      if (answer == choice.interval) return choice.label;
    }
  }
  if (hides_intensity && kind == AnswerKind::kMatch) return tr("set");
  if (kind == AnswerKind::kMatch) return level_words(block.quantity, answer);
  if (kind != AnswerKind::kYesNo && kind != AnswerKind::kInterval) {
    return answer_words(kind, answer);
  }
  const bool has_own_words = kind == AnswerKind::kInterval ||
                             task_of(block) == Task::kSameDifferent || !block.yes_label.empty();
  const auto [yes, no] = labels_of(block);
  return has_own_words ? (answer == 1.0 ? yes : no) : answer_words(kind, answer);
}

}  // namespace jnd::app
