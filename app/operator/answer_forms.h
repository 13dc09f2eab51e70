#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/operator/session_view.h"
#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What the answers of a study's blocks can be, and how they are told, in one of its languages.
struct AnswerForms {
  const experiments::Study& study;
  std::string language;          ///< Of the study's texts; where it lacks one, its first.
  bool hides_intensity = false;  ///< What was set in an adjustment is not told.

  /// A text of the study; "" for one that is empty.
  [[nodiscard]] std::string words(const experiments::Text& text) const;
  /// What yes and no are called, or the first and the second interval.
  [[nodiscard]] std::pair<std::string, std::string> labels_of(
      const experiments::Block& block) const;
  /// The intervals that can be chosen.
  [[nodiscard]] std::vector<TrialView::Choice> choices_of(
      const experiments::Block& block, const experiments::TrialForm& form) const;
  [[nodiscard]] AnswerForm form_of(const experiments::Block& block) const;
  /// As it was given: percent, 1 and 0, the interval chosen; none is "cannot tell". A chosen
  /// interval does not tell which held the test.
  [[nodiscard]] std::string in_words(const experiments::Block& block,
                                     const std::optional<double>& given) const;
};

}  // namespace jnd::app
