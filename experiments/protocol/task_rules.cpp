#include "experiments/protocol/task_rules.h"

#include <algorithm>
#include <string>

#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Returns among how many intervals the right one is chosen, or 0 if the task does not ask for
/// it.
int num_choices_of(const std::string& task) {
  if (task == "three_interval" || task == "oddity") return 3;
  return task == "abx" || task == "match_to_sample" ? 2 : 0;
}

class TaskRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    is_double_blind_ = word(file_.root(), "blinding") == "double";
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      if (word(stage, "kind") == "block") check_block(stage, pointer + '/');
    });
  }

 private:
  void check_block(const json& block, const std::string& at) {
    if (word(block, "task") == "same_different") check_same_different(block, at);
    if (num_choices_of(word(block, "task")) > 0) check_identification(block, at);
    const auto feedback = block.find("feedback");
    if (is_double_blind_ && feedback != block.end() && *feedback == true) {
      report(at + "feedback",
             "expected false, as the study is double-blind and whoever hears which answers are "
             "right learns the levels, found true");
    }
    if (block.contains("practice")) check_practice(block, at);
  }

  void check_same_different(const json& block, const std::string& at) {
    const std::string procedure = word(block, "procedure");
    const bool adapts = std::ranges::any_of(procedures(), [&](const Procedure* one) {
      return one->name() == procedure && one->adapts();
    });
    if (adapts) {
      report(at + "task", "expected `reminder`, `yes_no` or `two_interval`, as `" + procedure +
                              "` cannot follow how often the same is called different, found "
                              "`same_different`; `constant_stimuli` can ask so");
      return;
    }
    const json* catch_trials = number(block, "catch_trials");
    if (catch_trials != nullptr && *catch_trials == 0) {
      report(at + "catch_trials",
             "expected 1 or more, as without trials that are the same nobody can be seen to "
             "call them different, found 0");
    }
    const std::string quantity = quantity_of(word(block, "medium"));
    const json* reference = number(block, "reference_" + quantity);
    const json& tests = list(block, quantity);
    if (reference == nullptr) return;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      if (tests[i] != *reference) continue;
      report(at + quantity + '/' + std::to_string(i),
             "expected a stimulus that differs from the reference, found the reference, " +
                 tests[i].dump() + "; `catch_trials` are the trials that are the same");
    }
  }

  /// If a task asks for the right one of three intervals, there must be a right one.
  void check_identification(const json& block, const std::string& at) {
    const std::string task = word(block, "task");
    if (word(block, "procedure") == "limits") {
      report(at + "task",
             "expected `reminder`, `yes_no` or `two_interval`, as a series of `limits` ends "
             "where an answer changes and a guess changes any, found `" +
                 task + "`; `staircase` can ask so");
      return;
    }
    const std::string quantity = quantity_of(word(block, "medium"));
    const json* reference = number(block, "reference_" + quantity);
    const json& tests = list(block, quantity);
    if (reference == nullptr) return;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      if (!tests[i].is_number()) continue;
      const double excess = tests[i].get<double>() - reference->get<double>();
      const std::string here = at + quantity + '/' + std::to_string(i);
      if (excess == 0.0) {
        report(here,
               "expected a stimulus that differs from the reference, found the reference, " +
                   tests[i].dump() + "; `catch_trials` are the trials that are the same");
      } else if (excess < 0.0 && task == "three_interval") {
        report(here, "expected a stimulus above the reference (" + reference->dump() +
                         "), as the interval that has more is the right answer, found " +
                         tests[i].dump() + "; `oddity` may lie below");
      }
    }
  }

  void check_practice(const json& block, const std::string& at) {
    const json& practice = object_at(block, "practice");
    const json* judged = number(practice, "num_trials_judged");
    const json* most = number(practice, "max_trials");
    if (most == nullptr) return;
    const std::string pointer = at + "practice/max_trials";
    if (judged != nullptr && *most < *judged) {
      report(pointer, "expected a whole number >= `num_trials_judged` (" + judged->dump() +
                          "), found " + most->dump());
    }
    const json* repetitions = number(block, "repetitions");
    if (word(block, "procedure") != "constant_stimuli" || repetitions == nullptr) return;
    const std::size_t num_tests = list(block, quantity_of(word(block, "medium"))).size();
    const double num_trials = repetitions->get<double>() * (static_cast<double>(num_tests) +
                                                            num_catch_trials(block, num_tests));
    if (num_tests > 0 && most->get<double>() > num_trials) {
      report(pointer, "expected at most the trials of all `repetitions` (" +
                          plain_number(num_trials) + "), found " + most->dump());
    }
  }

  bool is_double_blind_ = false;
};

}  // namespace

void check_task_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  TaskRules(file, problems).run();
}

double num_catch_trials(const json& block, std::size_t num_tests) {
  const bool half = word(block, "task") == "same_different";
  return std::max(
      0.0, number_or(block, "catch_trials", half ? static_cast<double>(num_tests) : 0.0));
}

}  // namespace jnd::experiments
