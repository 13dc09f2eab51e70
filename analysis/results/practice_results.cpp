#include "analysis/results/study_sections.h"

namespace jnd::analysis {

std::optional<ResultsSection> practice_results(const StudyData& data) {
  if (data.practice.empty()) return std::nullopt;
  ResultsSection section{.name = "practice"};
  for (const PracticeRun& run : data.practice) {
    const auto add = [&](const std::string& name, double value, const std::string& problem) {
      section.participants.push_back({run.participant,
                                      run.block + "." + name,
                                      problem.empty() ? std::optional(value) : std::nullopt,
                                      {},
                                      problem});
    };
    add("num_trials", run.num_trials, "");
    add("num_judged", run.num_judged, run.problem);
    add("num_correct", run.num_correct, run.problem);
    add("criterion_met", run.criterion_met ? 1.0 : 0.0, run.problem);
  }
  return section;
}

}  // namespace jnd::analysis
