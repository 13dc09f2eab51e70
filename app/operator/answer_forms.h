#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/operator/session_view.h"
#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What the answers to a study's blocks can be, and their words in one of its languages.
struct AnswerForms {
  const experiments::Study& study;
  /// The language of the study's texts. If a text lacks it, the text's first language is used.
  std::string language;
  /// The intensity set in an adjustment is not told.
  bool hides_intensity = false;

  /// A text of the study in this language; "" for an empty text.
  [[nodiscard]] std::string words(const experiments::Text& text) const;
  /// The labels of yes and no, or of the first and the second interval.
  [[nodiscard]] std::pair<std::string, std::string> labels_of(
      const experiments::Block& block) const;
  /// The intervals that can be chosen.
  [[nodiscard]] std::vector<TrialView::Choice> choices_of(
      const experiments::Block& block, const experiments::TrialForm& form) const;
  [[nodiscard]] AnswerForm form_of(const experiments::Block& block) const;
  /// An answer in words, as it was given: a percentage, 1 and 0, or the chosen interval; none
  /// is "cannot tell". The chosen interval does not tell which one held the test.
  [[nodiscard]] std::string in_words(const experiments::Block& block,
                                     const std::optional<double>& given) const;
};

}  // namespace jnd::app
