#include <cmath>
#include <string>
#include <vector>

#include "experiments/order/counterbalance.h"
#include "experiments/protocol/starter_study.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
using namespace jnd::experiments;

void check_problems(const std::string& text, const std::vector<StudyProblem>& problems) {
  for (const StudyProblem& problem : problems) {
    fuzz::check_sentence(problem.message);
    fuzz::check_sentence(to_string(problem), 2000);
    fuzz::property(problem.line >= 1 && problem.column >= 1, "a problem has a place");
    fuzz::property(problem.pointer.empty() || problem.pointer.front() == '/',
                   "a pointer begins with /: " + problem.pointer);
  }
  try {
    static_cast<void>(read_study_text(text, "x"));
    fuzz::property(false, "a study with problems is not read");
  } catch (const ProtocolError& error) {
    fuzz::property(error.problems().size() == problems.size(), "both ways tell every problem");
  }
}

void check_plan(const Study& study) {
  const std::vector<Cell> cells = cells_of(study);
  fuzz::property(!cells.empty() && cells.size() <= 10000,
                 "a study has cells, and not too many");
  if (cells.size() > 50) return;
  for (const Cell& cell : cells) {
    fuzz::property(cell_from_text(study, to_string(cell)) == cell, "a cell reads back");
  }
  const std::vector<ParticipantPlan> plans =
      plan_participants(study, {.participants = {"P01", "P02"}, .seed = 1});
  for (const ParticipantPlan& plan : plans) {
    fuzz::property(std::isfinite(plan.duration_s) && plan.duration_s >= 0.0,
                   "a duration is finite");
    for (const PlannedBlock& block : plan.blocks) {
      fuzz::property(
          !block.trials.empty() && static_cast<int>(block.trials.size()) <= block.num_trials,
          "trials are drawn, at most those expected");
    }
  }
  for (const RangeEntry& entry :
       planned_range(study, {.max_force_per_point_n = 5.0, .max_total_force_n = 20.0})) {
    fuzz::property(std::isfinite(entry.total_force_n), "a planned force is finite");
  }
}

/// Checks the only function that writes a study, which puts its text under another name.
void check_renamed(const std::string& text, const Study& study) {
  const std::string renamed = renamed_study(text, "x", "renamed");
  const Study again = read_study_text(renamed, "x");
  fuzz::property(again.name == "renamed", "a renamed study has its new name");
  fuzz::property(again.stages.size() == study.stages.size(), "renaming keeps the stages");
  fuzz::property(renamed_study(renamed, "x", study.name).size() == text.size() ||
                     text.find('\\') != text.npos,
                 "renaming back gives the text");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  const std::vector<StudyProblem> problems = study_text_problems(text, "x");
  if (!problems.empty()) {
    check_problems(text, problems);
    return 0;
  }
  const Study study = read_study_text(text, "x");
  check_plan(study);
  check_renamed(text, study);
  return 0;
}
