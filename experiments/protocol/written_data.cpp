#include "experiments/protocol/written_data.h"

#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "experiments/procedures/procedure_registry.h"

namespace jnd::experiments {
namespace {

using Columns = std::vector<WrittenColumn>;

Columns answers(const std::string& item, const std::string& answer) {
  return {{"answers.csv", "item", "", item}, {"answers.csv", "answer", "", answer}};
}

/// Returns the columns of events.csv for events of kind `medium_explored`, one for each medium.
Columns explored_media() {
  return {{"events.csv", "kind", "", "`medium_explored`, one row a medium"},
          {"events.csv", "intensity", "unit of the quantity", "How much of the medium"},
          {"events.csv", "first_tick", "tick", "First sample in the recording"},
          {"events.csv", "last_tick", "tick", "Last sample in the recording"}};
}

Columns of_blocks() {
  const auto only = [](std::vector<std::string> procedures) {
    return std::vector<Condition>{{"procedure", std::move(procedures)}};
  };
  const std::vector<std::string> adjustments = {"magnitude_production", "matching"};
  const std::set<std::string_view> told_in_numbers = {
      "magnitude_estimation", "magnitude_production", "matching", "rating"};
  std::vector<std::string> askers;
  for (const Procedure* procedure : procedures()) {
    if (!told_in_numbers.contains(procedure->name())) askers.emplace_back(procedure->name());
  }
  const std::vector<Condition> asked = only(std::move(askers));
  const std::string unit = "unit of the quantity";
  return {
      {"trials.csv", "trial", "", "Running number in the session, from 1"},
      {"trials.csv", "attempt", "", "1, or more if the trial was repeated"},
      {"trials.csv", "block", "", "`name` of the block"},
      {"trials.csv", "procedure", "", "`procedure` of the block"},
      {"trials.csv", "medium", "", "`medium` of the block"},
      {"trials.csv", "quantity", "",
       "What an intensity is: `scale`, `viscosity_pa_s` or `stiffness_n_per_m`"},
      {"trials.csv", "repetition", "", "From 1"},
      {"trials.csv", "position", "", "Within the repetition, from 1"},
      {"trials.csv", "intensity", unit, "The test stimulus; of an adjustment the value set"},
      {"trials.csv", "reference_intensity", unit, "The reference stimulus", asked},
      {"trials.csv", "reference_intensity", "unit of the quantity of `standard_medium`",
       "The standard, a `standard_medium`", only({"matching"})},
      {"trials.csv", "test_interval", "",
       "Where the order is drawn: the interval of the test, 1 or 2. In `two_interval` the one "
       "chosen is `test_interval` where `response` is 1, else 3 - `test_interval`",
       asked},
      {"trials.csv", "intervals", "",
       "Of three intervals what each held, as in rtr: r the reference, t the test", asked},
      {"trials.csv", "right_interval", "", "Of three intervals the right answer, from 1",
       asked},
      {"trials.csv", "chosen_interval", "", "Of three intervals the one chosen, from 1", asked},
      {"trials.csv", "is_catch", "", "1: a catch trial", asked},
      {"trials.csv", "is_practice", "", "1: the block has `practice`; not for analysis", asked},
      {"trials.csv", "starting_intensity", unit, "Where the adjustment began",
       only(adjustments)},
      {"trials.csv", "target_percent", "%", "What it should feel like",
       only({"magnitude_production"})},
      {"trials.csv", "num_steps", "", "Steps of the adjustment", only(adjustments)},
      {"trials.csv", "reference_intensity", "unit of the quantity of `standard_medium`",
       "The standard, in trials that begin with it", only({"magnitude_estimation"})},
      {"trials.csv", "response", "%",
       "How strong it felt; with the `modulus` `standard` or `free` a number without unit",
       only({"magnitude_estimation"})},
      {"trials.csv", "response", unit, "The value that was set", only(adjustments)},
      {"trials.csv", "response", "", "The step of the scale, from 1", only({"rating"})},
      {"trials.csv", "response", "",
       "1: yes, different, the interval of the test, or of three the right one; 0: otherwise; "
       "with `cannot_tell` empty where nobody could tell",
       asked},
      {"trials.csv", "response_time_s", "s",
       "From the start of the last stimulus to the answer"},
      {"trials.csv", "num_presentations", "", "Stimuli felt in this attempt"},
      {"trials.csv", "first_tick", "tick", "First sample of the trial in the recording"},
      {"trials.csv", "last_tick", "tick", "Last sample of the trial in the recording"},
      {"events.csv", "kind", "",
       "`attempt_discarded`: the trial comes again, with `reason` in `data`, and "
       "`missed_deadline` where its answer missed `answer_deadline_s`"},
      {"questions.csv", "trial", "",
       "One row a trial and question of `questions`, with `block` and `question`"},
      {"questions.csv", "answer", "",
       "The number; the step of the scale; the `value` of the option; the words; `yes` or "
       "`no`, "
       "with `yes_no_which` also `yes: ...`; `no_answer` where it was left out"},
  };
}

}  // namespace

std::vector<WrittenColumn> written_columns(const ParameterTable& stage) {
  static const std::map<std::string, Columns> kColumns = {
      {"checklist", answers("`item_1`, `item_2` ... in the order of `items`", "`done`")},
      {"consent", answers("`consent`", "`given`")},
      {"explore", explored_media()},
      {"training", explored_media()},
      {"block", of_blocks()},
      {"post_experiment",
       answers("`name` of the item", "`yes` or `no`, or the words as they were typed")},
      {"questionnaire",
       answers("`name` of the item",
               "The number; the step of the scale; the `value` of the option; the words; `yes` "
               "or `no`, with `yes_no_which` also `yes: ...`")},
  };
  const auto found = kColumns.find(stage.name);
  return found == kColumns.end() ? Columns{} : found->second;
}

}  // namespace jnd::experiments
