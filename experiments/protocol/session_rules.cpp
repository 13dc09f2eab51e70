#include "experiments/protocol/session_rules.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "experiments/protocol/stage_tables.h"
#include "experiments/protocol/study_check.h"
#include "experiments/protocol/study_table.h"
#include "experiments/protocol/task_rules.h"
#include "experiments/study/rule_values.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// The arm that contains the stages. The names are empty outside of a `one_of` counterbalance.
struct Surroundings {
  std::string counterbalance, arm;
  std::set<std::string> arms;  ///< All arms of the counterbalance.
};

/// Longest durations of a part of the study, in seconds.
struct Duration {
  double for_everyone_s = 0.0;
  /// The durations of the arms of `one_of` counterbalances.
  std::map<std::pair<std::string, std::string>, double> of_arm_s{};

  void add(const Duration& other) {
    for_everyone_s += other.for_everyone_s;
    for (const auto& [arm, duration_s] : other.of_arm_s) of_arm_s[arm] += duration_s;
  }
  /// Returns the duration of a participant who gets the longest arm of every counterbalance.
  [[nodiscard]] double longest_s() const {
    std::map<std::string, double> longest;
    for (const auto& [arm, duration_s] : of_arm_s) {
      longest[arm.first] = std::max(longest[arm.first], duration_s);
    }
    double total_s = for_everyone_s;
    for (const auto& [counterbalance, duration_s] : longest) total_s += duration_s;
    return total_s;
  }
};

class SessionRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    if (!file_.root().is_object()) return;
    const ParameterTable& device = *study_table().find("device")->nested;
    const double usual_ramp_s = json::parse(device.find("ramp_s")->default_json).get<double>();
    ramp_s_ = sound_number(device, object_at(file_.root(), "device"), "ramp_s", usual_ramp_s);
    const Duration all = stages(list(file_.root(), "stages"), "/stages", {});
    check_duration(all.longest_s());
  }

 private:
  Duration stages(const json& stages, const std::string& pointer, const Surroundings& around) {
    Duration sum;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (!stages[i].is_object()) continue;
      const std::string here = pointer + '/' + std::to_string(i);
      if (word(stages[i], "kind") == "counterbalance") {
        sum.add(counterbalance(stages[i], here));
      } else {
        check_reached(stages[i], here, around);
        sum.add(limited_to_arms(stages[i], duration_s(stages[i], here), around));
      }
    }
    return sum;
  }

  Duration counterbalance(const json& stage, const std::string& pointer) {
    Duration sum;
    const json& arms = list(stage, "arms");
    const bool is_one_of = word(stage, "method") == "one_of";
    for (std::size_t i = 0; i < arms.size(); ++i) {
      if (!arms[i].is_object()) continue;
      Surroundings around;
      if (is_one_of) around = {word(stage, "name"), word(arms[i], "name"), arm_names(arms)};
      sum.add(stages(list(arms[i], "stages"),
                     pointer + "/arms/" + std::to_string(i) + "/stages", around));
    }
    Duration between = stages(list(stage, "between"), pointer + "/between", {});
    for (std::size_t i = 1; i < arms.size(); ++i) sum.add(between);
    return sum;
  }

  static std::set<std::string> arm_names(const json& arms) {
    std::set<std::string> names;
    for (const json& arm : arms) {
      if (arm.is_object()) names.insert(word(arm, "name"));
    }
    return names;
  }

  /// A stage in an arm runs for nobody if it is only for another arm of the same
  /// counterbalance.
  void check_reached(const json& stage, const std::string& pointer,
                     const Surroundings& around) {
    const std::string wanted = word(object_at(stage, "only_for"), around.counterbalance);
    // Another rule reports names that no arm has.
    if (wanted.empty() || wanted == around.arm || !around.arms.contains(wanted)) return;
    report(pointer + "/only_for/" + pointer_token(around.counterbalance),
           "expected `" + shown_text(around.arm) +
               "`, the arm that this stage stands in, or nothing, found `" +
               shown_text(wanted) + "`; nobody would get the stage");
  }

  static Duration limited_to_arms(const json& stage, double duration_s,
                                  const Surroundings& around) {
    Duration duration;
    if (!around.arm.empty()) {
      duration.of_arm_s[{around.counterbalance, around.arm}] = duration_s;
      return duration;
    }
    for (const auto& [counterbalance, arm] : object_at(stage, "only_for").items()) {
      if (counterbalance == "comment" || !arm.is_string()) continue;
      duration.of_arm_s[{counterbalance, arm.get<std::string>()}] = duration_s;
      // If a stage has several conditions, one is enough to give an upper bound.
      return duration;
    }
    duration.for_everyone_s = duration_s;
    return duration;
  }

  /// Returns the durations that the file states, in seconds. Questions and checklists count as
  /// 0.
  double duration_s(const json& stage, const std::string& pointer) {
    const std::string kind = word(stage, "kind");
    double duration_s = 0.0;
    if (kind == "break") {
      duration_s = sound_number(*stage_table(kind), stage, "duration_s", 0.0);
    }
    if (kind == "explore") duration_s = media_duration_s(stage, pointer, "media");
    if (kind == "training") duration_s = media_duration_s(stage, pointer, "examples");
    if (kind == "block") duration_s = block_duration_s(stage);
    for (const json& block : list(stage, "blocks")) {
      if (kind == "interleaved" && block.is_object()) duration_s += block_duration_s(block);
    }
    if (duration_s > longest_stage_s_) {
      longest_stage_s_ = duration_s;
      longest_stage_ = pointer;
    }
    return duration_s;
  }

  static double block_duration_s(const json& block) {
    const ParameterTable& table = *stage_table("block");
    const double trial_s = sound_number(table, block, "expected_trial_s", 0.0) +
                           sound_number(table, block, "free_space_between_s", 0.0);
    const json& levels = list(block, quantity_of(word(block, "medium")));
    // A list that is too long is reported as a whole.
    const Parameter* its = block_table().find(quantity_of(word(block, "medium")));
    if (its != nullptr && levels.size() > its->max_items) return 0.0;
    return trial_s *
           (static_cast<double>(levels.size()) + num_catch_trials(block, levels.size())) *
           sound_number(table, block, "repetitions", 1.0) * num_showings(block);
  }

  double media_duration_s(const json& stage, const std::string& pointer,
                          const std::string& key) {
    const ParameterTable& table = *stage_table(word(stage, "kind"))->find(key)->nested;
    double sum_s = 0.0;
    const json& media = list(stage, key);
    for (std::size_t i = 0; i < media.size(); ++i) {
      if (!media[i].is_object()) continue;
      const double duration_s = sound_number(table, media[i], "duration_s", 0.0);
      sum_s += duration_s;
      if (duration_s > ramp_s_ || !(duration_s > 0.0)) continue;
      report(pointer + '/' + key + '/' + std::to_string(i) + "/duration_s",
             "expected a time longer than the device's `ramp_s` (" + plain_number(ramp_s_) +
                 " s), in which the medium only comes up, found " + plain_number(duration_s));
    }
    return sum_s;
  }

  void check_duration(double longest_s) {
    constexpr double kMostHours = 8.0;
    const auto hours = [](double s) { return plain_number(std::round(s / 360.0) / 10.0); };
    if (!(longest_s > kMostHours * 3600.0)) return;
    report(longest_stage_, "expected a session of at most " + plain_number(kMostHours) +
                               " hours, found one of about " + hours(longest_s) + ", " +
                               hours(longest_stage_s_) +
                               " of them in this stage; times are in seconds");
  }

  double ramp_s_ = 0.0;
  double longest_stage_s_ = 0.0;
  std::string longest_stage_;
};

}  // namespace

void check_session_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  SessionRules(file, problems).run();
}

}  // namespace jnd::experiments
