#pragma once

#include <map>
#include <string>

#include "experiments/study/study.h"

namespace jnd::analysis {

/// The names that a report uses for a study and its parts. They are in English if the study has
/// English ones.
struct StudyTitles {
  /// The study's title, or its name if it has no title.
  std::string study;
  /// The titles of the stages that have one, by name.
  std::map<std::string, std::string> stages;

  /// The title of a block, or its name if it has no title.
  [[nodiscard]] std::string title_of(const std::string& block) const;
  /// The title up to its colon: "Group D" for "Group D: low viscosities".
  [[nodiscard]] std::string short_title_of(const std::string& block) const;
  /// The name of a comparison with short titles for the names of blocks before its colon:
  /// "Group D - Group E: peak speed" for "group_d - group_e: peak speed". Other names stay.
  [[nodiscard]] std::string titled(const std::string& comparison) const;
};

[[nodiscard]] StudyTitles titles_of(const experiments::Study& study);

/// For example "test first" for "test_first".
[[nodiscard]] std::string in_words(std::string name);
/// A label for an axis, such as "Viscosity [Pa s]".
[[nodiscard]] std::string quantity_axis(const std::string& quantity);
/// A block's procedure and the question that it asks, such as "method of constant stimuli as a
/// two-interval task (order drawn)".
[[nodiscard]] std::string procedure_words(const experiments::Block& block);

}  // namespace jnd::analysis
