#pragma once

#include <map>
#include <string>
#include <vector>

namespace jnd::analysis {

/// A block that people practise in, as the study file has it.
struct PracticeWords {
  std::string block, procedure, task, interval_order;
  std::string quantity;        ///< Of its levels: "viscosity_pa_s".
  std::vector<double> levels;  ///< In the order of the file.
  std::vector<double> references;
  double min_correct_ratio = 0.0;
  int num_trials_judged = 0, max_trials = 0;
  bool feedback = false;
};

/// What a study file says of itself to readers, in English where it has it.
struct StudyWords {
  std::string title;  ///< Its name where it has no title.
  std::string description, citation, blinding;
  std::vector<std::string> authors;
  std::map<std::string, std::string> titles;  ///< Titles of stages, by their names.
  std::map<std::string, std::string>
      questions;  ///< Questions of blocks and items, by their names.

  std::vector<PracticeWords> practice;  ///< In the order of the file.

  /// The title of a block; its name where it has none.
  [[nodiscard]] std::string title_of(const std::string& block) const;
  /// Up to its colon: "Group D" of "Group D: low viscosities".
  [[nodiscard]] std::string short_title_of(const std::string& block) const;
};

/// Of a study file's text; empty words for a text that is no study.
[[nodiscard]] StudyWords study_words_of(const std::string& protocol_text);

/// "test first" of "test_first".
[[nodiscard]] std::string in_words(std::string name);
/// "viscosity", "scaling factor": what varies, from the quantity's name.
[[nodiscard]] std::string quantity_words(const std::string& quantity);
/// "Viscosity [Pa s]", for an axis.
[[nodiscard]] std::string quantity_axis(const std::string& quantity);
/// "constant stimuli": a procedure in words; of two intervals how their order comes about,
/// "random" or "balanced".
[[nodiscard]] std::string procedure_words(const std::string& procedure,
                                          const std::string& task = "reminder",
                                          const std::string& interval_order = "random");

}  // namespace jnd::analysis
