#include "experiments/protocol/timing_rules.h"

#include <algorithm>
#include <string>
#include <vector>

#include "experiments/protocol/stage_tables.h"
#include "experiments/protocol/study_check.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Returns how many stimuli a trial has before it can be answered, as far as the block's keys
/// tell.
int num_stimuli_of(const json& block) {
  const std::string procedure = word(block, "procedure");
  if (procedure == "matching") return 2;
  if (procedure == "magnitude_estimation") return 1;  // Some trials may have no standard.
  const std::string task = word(block, "task");
  if (task == "three_interval" || task == "oddity" || task == "abx" ||
      task == "match_to_sample") {
    return 3;
  }
  const std::vector<std::string>& asking =
      block_table().find("task")->only_where.front().values;
  const bool compares = std::ranges::find(asking, procedure) != asking.end();
  return compares && task != "yes_no" ? 2 : 1;
}

class TimingRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    if (!file_.root().is_object()) return;
    const ParameterTable& device = *study_table().find("device")->nested;
    const double usual_ramp_s = json::parse(device.find("ramp_s")->default_json).get<double>();
    ramp_s_ = sound_number(device, object_at(file_.root(), "device"), "ramp_s", usual_ramp_s);
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      if (word(stage, "kind") == "block") check_block(stage, pointer + '/');
    });
  }

 private:
  void check_block(const json& block, const std::string& at) {
    const double min_s = sound_number(block_table(), block, "min_stimulus_s", 0.0);
    const double max_s = sound_number(block_table(), block, "max_stimulus_s", 0.0);
    const double deadline_s = sound_number(block_table(), block, "answer_deadline_s", 0.0);
    const double trial_s = sound_number(block_table(), block, "expected_trial_s", 0.0);
    if (max_s > 0.0 && max_s <= ramp_s_) {
      report(at + "max_stimulus_s",
             "expected a time longer than the device's `ramp_s` (" + plain_number(ramp_s_) +
                 " s), in which the stimulus only comes up, found " + plain_number(max_s));
    } else if (max_s > 0.0 && max_s < min_s) {
      report(at + "max_stimulus_s",
             "expected a time >= `min_stimulus_s` (" + plain_number(min_s) +
                 " s), for which it has to be felt, found " + plain_number(max_s));
    }
    if (deadline_s > 0.0 && deadline_s <= min_s) {
      report(at + "answer_deadline_s",
             "expected a time longer than `min_stimulus_s` (" + plain_number(min_s) +
                 " s), before which nobody may answer, found " + plain_number(deadline_s) +
                 "; both count from the start of the last stimulus");
    }
    const double least_s = num_stimuli_of(block) * min_s;
    if (trial_s > 0.0 && trial_s < least_s) {
      report(at + "expected_trial_s",
             "expected at least " + plain_number(least_s) + " s, as a trial has " +
                 std::to_string(num_stimuli_of(block)) +
                 " stimuli of `min_stimulus_s` each, found " + plain_number(trial_s));
    }
  }

  double ramp_s_ = 0.0;
};

}  // namespace

void check_timing_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  TimingRules(file, problems).run();
}

}  // namespace jnd::experiments
