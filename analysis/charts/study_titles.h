#pragma once

#include <map>
#include <string>

#include "experiments/study/study.h"

namespace jnd::analysis {

/// What readers of a report call a study and its parts: in English where the study has it.
struct StudyTitles {
  std::string study;                          ///< Its name where it has no title.
  std::map<std::string, std::string> stages;  ///< Titles by name, of those that have one.

  /// The title of a block; its name where it has none.
  [[nodiscard]] std::string title_of(const std::string& block) const;
  /// Up to its colon: "Group D" of "Group D: low viscosities".
  [[nodiscard]] std::string short_title_of(const std::string& block) const;
};

[[nodiscard]] StudyTitles titles_of(const experiments::Study& study);

/// "test first" of "test_first".
[[nodiscard]] std::string in_words(std::string name);
/// "Viscosity [Pa s]", for an axis.
[[nodiscard]] std::string quantity_axis(const std::string& quantity);
/// "method of constant stimuli as a two-interval task (order drawn)": a block's procedure, with
/// the question that it asks.
[[nodiscard]] std::string procedure_words(const experiments::Block& block);

}  // namespace jnd::analysis
