#include "analysis/charts/study_titles.h"

#include <algorithm>

#include "analysis/data/stored_studies.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/task.h"
#include "experiments/study/media.h"
#include "experiments/study/stage_walk.h"

namespace jnd::analysis {

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string StudyTitles::title_of(const std::string& block) const {
  const auto found = stages.find(block);
  return found == stages.end() ? in_words(block) : found->second;
}

std::string StudyTitles::short_title_of(const std::string& block) const {
  const std::string whole = title_of(block);
  return whole.substr(0, whole.find(": "));
}

StudyTitles titles_of(const experiments::Study& study) {
  StudyTitles titles{.study = in_english(study.title)};
  if (titles.study.empty()) titles.study = in_words(study.name);
  for_each_stage(study.stages, [&](const experiments::Stage& stage) {
    const std::string title = in_english(stage.title);
    if (!title.empty()) titles.stages.emplace(stage.name, title);
  });
  return titles;
}

std::string quantity_axis(const std::string& quantity) {
  std::string words = experiments::quantity_words(quantity);
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') {
    words[0] = static_cast<char>(words[0] - 'a' + 'A');
  }
  const std::string unit = experiments::quantity_unit(quantity);
  return unit.empty() ? words : words + " [" + unit + "]";
}

std::string procedure_words(const experiments::Block& block) {
  using experiments::Measure;
  using experiments::Task;
  const experiments::Procedure& procedure = experiments::procedure_named(block.procedure);
  std::string words = procedure.words();
  const Measure measures = procedure.measures(block);
  if (measures == Measure::kDetection) return words + " as a yes-no task";
  const bool is_balanced = block.settings.has("interval_order") &&
                           block.settings.word("interval_order") == "balanced";
  const std::string order = is_balanced ? " (order balanced)" : " (order drawn)";
  if (measures == Measure::kDifference) return words + " as a same-different task" + order;
  if (measures == Measure::kIdentification) {
    const Task task = task_of(block);
    return words +
           (task == Task::kThreeInterval ? " as a three-interval forced choice"
            : task == Task::kOddity      ? " as an oddity task"
            : task == Task::kAbx         ? " as an ABX task"
                                         : " as a match-to-sample task") +
           " (every order equally often)";
  }
  if (measures != Measure::kComparison) return words;
  if (task_of(block) == Task::kTwoInterval) return words + " as a two-interval task" + order;
  if (procedure.adapts()) return words;
  return words + " as a reminder task (reference first, yes or no)";
}

}  // namespace jnd::analysis
