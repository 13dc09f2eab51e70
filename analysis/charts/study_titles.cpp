#include "analysis/charts/study_titles.h"

#include <algorithm>

#include "analysis/data/stored_studies.h"
#include "analysis/words/said.h"
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

std::string StudyTitles::titled(const std::string& comparison) const {
  const std::size_t colon = std::min(comparison.find(": "), comparison.size());
  std::string words;
  for (std::size_t begin = 0; begin < colon;) {
    const std::size_t end = std::min(comparison.find(" - ", begin), colon);
    const std::string part = comparison.substr(begin, end - begin);
    words += (begin == 0 ? "" : " - ") + (stages.contains(part) ? short_title_of(part) : part);
    begin = end + (end < colon ? 3 : 0);
  }
  return words + comparison.substr(colon);
}

StudyTitles titles_of(const experiments::Study& study) {
  StudyTitles titles{.study = in_spoken_language(study.title)};
  if (titles.study.empty()) titles.study = in_words(study.name);
  for_each_stage(study.stages, [&](const experiments::Stage& stage) {
    const std::string title = in_spoken_language(stage.title);
    if (!title.empty()) titles.stages.emplace(stage.name, title);
  });
  return titles;
}

std::string quantity_axis(const std::string& quantity) {
  std::string words = said_of(experiments::quantity_words(quantity));
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
  std::string words = said_of(procedure.words());
  const Measure measures = procedure.measures(block);
  if (measures == Measure::kDetection) return said("{} as a yes-no task", words);
  const bool is_balanced = block.settings.has("interval_order") &&
                           block.settings.word("interval_order") == "balanced";
  const std::string order = is_balanced ? said(" (order balanced)") : said(" (order drawn)");
  if (measures == Measure::kDifference)
    return said("{} as a same-different task{}", words, order);
  if (measures == Measure::kIdentification) {
    const Task task = task_of(block);
    return said("{}{} (every order equally often)", words,
                (task == Task::kThreeInterval ? said(" as a three-interval forced choice")
                 : task == Task::kOddity      ? said(" as an oddity task")
                 : task == Task::kAbx         ? said(" as an ABX task")
                                              : said(" as a match-to-sample task")));
  }
  if (measures != Measure::kComparison) return words;
  if (task_of(block) == Task::kTwoInterval)
    return said("{} as a two-interval task{}", words, order);
  if (procedure.adapts()) return words;
  return said("{} as a reminder task (reference first, yes or no)", words);
}

}  // namespace jnd::analysis
