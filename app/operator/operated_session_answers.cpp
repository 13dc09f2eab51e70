#include "app/operator/answer_forms.h"
#include "app/operator/operated_session.h"

// What the answers of a block can be, and their words.

namespace jnd::app {

using namespace experiments;

AnswerForms OperatedSession::answer_forms() const {
  return {.study = parameters_.study,
          .language = language_,
          .hides_intensity = hides_levels_ || is_alone()};
}

std::string OperatedSession::words(const Text& text) const {
  return answer_forms().words(text);
}

std::pair<std::string, std::string> OperatedSession::labels_of(const Block& block) const {
  return answer_forms().labels_of(block);
}

std::vector<TrialView::Choice> OperatedSession::choices_of(const Block& block,
                                                           const TrialForm& form) const {
  return answer_forms().choices_of(block, form);
}

AnswerForm OperatedSession::form_of(const Block& block) const {
  return answer_forms().form_of(block);
}

std::string OperatedSession::answer_in_words(const Block& block,
                                             const std::optional<double>& given) const {
  return answer_forms().in_words(block, given);
}

}  // namespace jnd::app
