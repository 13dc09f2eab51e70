#include "experiments/protocol/study_rules.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/marker.h"
#include "core/media/force_map.h"
#include "experiments/protocol/design_rules.h"
#include "experiments/protocol/interleaved_rules.h"
#include "experiments/protocol/label_rules.h"
#include "experiments/protocol/order_rules.h"
#include "experiments/protocol/participant_field_rules.h"
#include "experiments/protocol/sequential_rules.h"
#include "experiments/protocol/session_rules.h"
#include "experiments/protocol/sound_rules.h"
#include "experiments/protocol/stage_tables.h"
#include "experiments/protocol/standard_rules.h"
#include "experiments/protocol/study_check.h"
#include "experiments/protocol/task_rules.h"
#include "experiments/protocol/timing_rules.h"
#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/shown_text.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class Rules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    if (!file_.root().is_object()) return;
    const json& stages = list(file_.root(), "stages");
    collect_arms(stages);
    check_stages(stages, "/stages", false);
    check_num_cells();
    check_num_trials();
    check_wall();
    check_force_map();
    check_markers();
  }

 private:
  /// Reports a name that another pointer of the same namespace has already.
  void check_unique(std::map<std::string, std::string>& known, const std::string& name,
                    const std::string& pointer) {
    if (name.empty()) return;
    const auto [first, is_new] = known.emplace(name, pointer);
    if (!is_new) {
      report(pointer, "expected a name of its own, found `" + shown_text(name) +
                          "`, the name of " +
                          first->second.substr(0, first->second.rfind('/')) + " already");
    }
  }

  void collect_arms(const json& stages) {
    for (const json& field : list(file_.root(), "participant_fields")) {
      if (!field.is_object()) continue;
      fields_.insert(word(field, "name"));
      num_cells_ *= std::max(1.0, static_cast<double>(list(field, "options").size()));
    }
    for (const json& stage : stages) {
      if (!stage.is_object() || word(stage, "kind") != "counterbalance") continue;
      methods_[word(stage, "name")] = word(stage, "method");
      if (word(stage, "method") == "one_of") {
        for (const json& arm : list(stage, "arms")) {
          if (arm.is_object()) one_of_arms_[word(stage, "name")].push_back(word(arm, "name"));
        }
      }
      const double num_arms = static_cast<double>(list(stage, "arms").size());
      const bool is_order = word(stage, "method") == "order";
      num_cells_ *= !is_order       ? std::max(1.0, num_arms)
                    : num_arms == 3 ? 6.0
                                    : (num_arms > 3 && list(stage, "arms").size() % 2 == 1
                                           ? 2.0 * num_arms
                                           : std::max(1.0, num_arms));
    }
  }

  void check_num_cells() {
    constexpr double kMostCells = 10000.0;
    if (num_cells_ > kMostCells) {
      report("/stages", "expected fields, counterbalances and squares that cross to at most " +
                            plain_number(kMostCells) + " cells, found " +
                            plain_number(num_cells_));
    }
  }

  /// A wall needs a limit of the fluid, and friction needs a wall.
  void check_wall() {
    const json& immersion = object_at(object_at(file_.root(), "device"), "immersion");
    const std::string pointer = "/device/immersion/wall_";
    const bool has_wall = number(immersion, "wall_stiffness_n_per_m") != nullptr;
    if (has_wall && !immersion.contains("radius_m") && !immersion.contains("depth_m")) {
      report(pointer + "stiffness_n_per_m",
             "expected this key only beside `radius_m` or `depth_m`, which say where the wall "
             "is, found neither");
    }
    if (!immersion.contains("wall_stiffness_n_per_m") &&
        number_or(immersion, "wall_friction_ratio", 0.0) > 0.0) {
      report(pointer + "friction_ratio",
             "expected this key only beside `wall_stiffness_n_per_m`, found no wall");
    }
  }

  /// Checks what involves several rows: angles and speeds must form a grid, and lift must have
  /// a side to point to.
  void check_force_map() {
    const std::string pointer = "/device/force_map";
    const json& listed = list(object_at(file_.root(), "device"), "force_map");
    if (listed.empty()) return;
    for (const StudyProblem& problem : problems_) {
      if (problem.pointer.starts_with(pointer)) return;
    }
    std::vector<core::ForceMap::Row> rows;
    for (std::size_t i = 0; i < listed.size(); ++i) {
      if (!listed[i].is_object()) return;
      const json* angle = number(listed[i], "angle_of_attack_rad");
      const json* speed = number(listed[i], "speed_m_per_s");
      const json* drag = number(listed[i], "drag_coefficient");
      const json* lift = number(listed[i], "lift_coefficient");
      // Incomplete rows are reported already, unless there was too much to report.
      if (angle == nullptr || speed == nullptr || drag == nullptr) return;
      rows.push_back({.angle_of_attack_rad = angle->get<double>(),
                      .speed_m_per_s = speed->get<double>(),
                      .drag_coefficient = drag->get<double>(),
                      .lift_coefficient = lift == nullptr ? 0.0 : lift->get<double>(),
                      .line = file_.value_position(pointer + '/' + std::to_string(i)).line});
    }
    try {
      const core::ForceMap map(std::move(rows));
    } catch (const core::Error& error) {
      report(pointer, error.what());
    }
  }

  /// The kinds of markers need different codes, so that the recorder's channel tells them
  /// apart.
  void check_markers() {
    const json& markers = object_at(file_.root(), "markers");
    std::map<double, std::string_view> known;  // Codes, with the kind that has each.
    for (std::size_t kind = 0; kind < core::kNumMarkerKinds; ++kind) {
      const std::string name(core::kMarkerNames[kind]);
      const double code = number_or(markers, name, core::MarkerCodes{}.codes[kind]);
      if (code == 0.0) continue;
      const auto [first, is_new] = known.emplace(code, core::kMarkerNames[kind]);
      if (is_new) continue;
      // Of two equal codes, the one that the file states is reported; the other is a default.
      report("/markers/" + (markers.contains(name) ? name : std::string(first->second)),
             "expected a code of its own, found " + plain_number(code) + ", that of `" +
                 (markers.contains(name) ? std::string(first->second) : name) + "` already");
    }
  }

  /// Far more than a person can do. A plan draws all trials, so there must be a limit.
  void check_num_trials() {
    constexpr double kMostTrials = 50000.0;
    if (num_trials_ > kMostTrials) {
      report("/stages", "expected at most " + plain_number(kMostTrials) +
                            " trials in all blocks together, found " +
                            plain_number(num_trials_));
    }
  }

  void check_stages(const json& stages, const std::string& pointer, bool inside) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (stages[i].is_object()) {
        check_stage(stages[i], pointer + '/' + std::to_string(i), inside);
      }
    }
  }

  void check_stage(const json& stage, const std::string& pointer, bool inside) {
    check_unique(stage_names_, word(stage, "name"), pointer + "/name");
    check_only_for(stage, pointer);
    const std::string kind = word(stage, "kind");
    if (kind == "block") {
      check_block(stage, pointer);
      check_standard(file_, stage, pointer, problems_);
      std::map<std::string, std::string> names;  // Another block may ask the same question.
      check_items(list(stage, "questions"), pointer + "/questions", names);
    }
    if (kind == "questionnaire" || kind == "post_experiment") {
      check_items(list(stage, "items"), pointer + "/items", item_names_);
    }
    if (kind == "interleaved") check_stages(list(stage, "blocks"), pointer + "/blocks", true);
    if (kind != "counterbalance") return;
    if (inside) {
      report(pointer + "/kind",
             "expected no counterbalance inside another, found one; side by side they are "
             "crossed");
    }
    check_counterbalance(stage, pointer);
  }

  void check_counterbalance(const json& stage, const std::string& pointer) {
    std::map<std::string, std::string> arm_names;
    const json& arms = list(stage, "arms");
    for (std::size_t i = 0; i < arms.size(); ++i) {
      if (!arms[i].is_object()) continue;
      const std::string arm = pointer + "/arms/" + std::to_string(i);
      check_unique(arm_names, word(arms[i], "name"), arm + "/name");
      const json& stages = list(arms[i], "stages");
      const std::string method = word(stage, "method");
      if ((method == "order" || method == "latin") && arms[i].contains("stages") &&
          stages.empty() && arms[i]["stages"].is_array()) {
        report(arm + "/stages", "expected one or more stages, as `method` is `" + method +
                                    "`, found an empty list");
      }
      check_stages(stages, arm + "/stages", true);
    }
    check_stages(list(stage, "between"), pointer + "/between", true);
  }

  void check_only_for(const json& stage, const std::string& pointer) {
    const auto only_for = stage.find("only_for");
    if (only_for == stage.end() || !only_for->is_object()) return;
    for (const auto& [counterbalance, arm] : only_for->items()) {
      if (counterbalance == "comment" || !arm.is_string()) continue;
      const std::string child = pointer + "/only_for/" + pointer_token(counterbalance);
      const auto known = one_of_arms_.find(counterbalance);
      if (known == one_of_arms_.end()) {
        std::vector<std::string> names;
        for (const auto& [name, arms] : one_of_arms_) names.push_back(name);
        const std::string expected = "expected the name of a `one_of` counterbalance";
        const std::string found = ", found `" + shown_text(counterbalance) + "`";
        const auto other = methods_.find(counterbalance);
        const std::string known_names =
            " (" + (names.empty() ? "there is none" : names_words(names)) + ")";
        if (fields_.contains(counterbalance)) {
          report(child, expected + known_names + found +
                            ", a participant field, which cannot choose who gets a stage");
        } else if (other == methods_.end() || other->second.empty()) {
          report(child, expected + found + did_you_mean(counterbalance, names));
        } else {
          report(child, expected + known_names + found + ", whose method is `" +
                            shown_text(other->second) +
                            "` and of which everybody gets every arm");
        }
      } else if (std::find(known->second.begin(), known->second.end(), arm) ==
                 known->second.end()) {
        report(child, "expected an arm of `" + shown_text(counterbalance) +
                          "`: " + names_words(known->second) + ", found `" +
                          shown_text(arm.get<std::string>()) + "`" +
                          did_you_mean(arm.get<std::string>(), known->second));
      }
    }
  }

  /// `names` maps the names of earlier items to their pointers.
  void check_items(const json& items, const std::string& pointer,
                   std::map<std::string, std::string>& names) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (!items[i].is_object()) continue;
      const std::string item = pointer + '/' + std::to_string(i);
      check_unique(names, word(items[i], "name"), item + "/name");
      std::map<std::string, std::string> values;
      const json& options = list(items[i], "options");
      for (std::size_t j = 0; j < options.size(); ++j) {
        if (!options[j].is_object()) continue;
        check_unique(values, word(options[j], "value"),
                     item + "/options/" + std::to_string(j) + "/value");
      }
      const json* minimum = number(items[i], "minimum");
      const json* maximum = number(items[i], "maximum");
      if (minimum != nullptr && maximum != nullptr &&
          !(minimum->get<double>() < maximum->get<double>())) {
        report(item + "/maximum", "expected a number > `minimum` (" + minimum->dump() +
                                      "), found " + maximum->dump());
      }
    }
  }

  void check_block(const json& block, const std::string& pointer) {
    const std::string quantity = quantity_of(word(block, "medium"));
    if (quantity.empty()) return;
    const std::string procedure = word(block, "procedure");
    const std::string at = pointer + '/';
    std::map<double, std::size_t> seen;
    const json& values = list(block, quantity);
    // A list that is too long is reported as a whole.
    if (const Parameter* levels = block_table().find(quantity);
        levels != nullptr && values.size() > levels->max_items) {
      return;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!values[i].is_number()) continue;
      const std::string here = at + quantity + '/' + std::to_string(i);
      const auto [first, is_new] = seen.emplace(values[i].get<double>(), i);
      if (!is_new) {
        report(here, "expected each value once, found " + values[i].dump() + " at index " +
                         std::to_string(first->second) + " already");
      }
      if (procedure == "constant_stimuli" && quantity == "scale" &&
          values[i].get<double>() == 0.0) {
        report(here, "expected a number > 0, as `constant_stimuli` compares ratios, found " +
                         values[i].dump());
      }
    }
    const json* repetitions = number(block, "repetitions");
    num_trials_ +=
        (static_cast<double>(values.size()) + num_catch_trials(block, values.size())) *
        (repetitions == nullptr ? 1.0 : std::max(1.0, repetitions->get<double>())) *
        num_showings(block);
    num_cells_ *= num_rows(word(object_at(block, "order"), "method"), values.size());
    if (seen.empty()) return;
    if (procedure == "constant_stimuli") check_reference(block, at, quantity, seen);
    if (procedure == "magnitude_production" || procedure == "matching") {
      check_steps(block, at, quantity, seen);
    }
  }

  /// Returns the number of rows of the square that participants get; 1 without a square.
  static double num_rows(const std::string& method, std::size_t num_stimuli) {
    const double n = std::max(1.0, static_cast<double>(num_stimuli));
    if (method == "latin") return n;
    if (method == "williams") return num_stimuli % 2 == 1 && num_stimuli > 1 ? 2.0 * n : n;
    return 1.0;
  }

  void check_reference(const json& block, const std::string& at, const std::string& quantity,
                       const std::map<double, std::size_t>& seen) {
    const std::string key = "reference_" + quantity;
    const json* reference = number(block, key);
    const std::string task = word(block, "task");
    const bool lies_between = task.empty() || task == "reminder" || task == "two_interval";
    if (reference == nullptr || !lies_between) return;
    const double value = reference->get<double>();
    if (!(value > seen.begin()->first && value < seen.rbegin()->first)) {
      report(at + key,
             "expected a number between the smallest and the largest test stimulus (" +
                 plain_number(seen.begin()->first) + " and " +
                 plain_number(seen.rbegin()->first) + "), found " + reference->dump());
    }
  }

  void check_steps(const json& block, const std::string& at, const std::string& quantity,
                   const std::map<double, std::size_t>& seen) {
    const json* coarse = number(block, "coarse_step_" + quantity);
    const json* fine = number(block, "fine_step_" + quantity);
    if (coarse != nullptr && fine != nullptr &&
        !(fine->get<double>() < coarse->get<double>())) {
      report(at + "fine_step_" + quantity, "expected a number < `coarse_step_" + quantity +
                                               "` (" + coarse->dump() + "), found " +
                                               fine->dump());
    }
    const json* max = number(block, "max_" + quantity);
    if (max != nullptr && !(max->get<double>() >= seen.rbegin()->first)) {
      report(at + "max_" + quantity, "expected a number >= the largest starting value (" +
                                         plain_number(seen.rbegin()->first) + "), found " +
                                         max->dump());
    }
  }

  /// Names, with their pointers.
  std::map<std::string, std::string> stage_names_, item_names_;
  std::map<std::string, std::vector<std::string>> one_of_arms_;
  std::set<std::string> fields_;                ///< Names of the study's participant fields.
  std::map<std::string, std::string> methods_;  ///< Methods of counterbalances, by name.
  double num_cells_ = 1.0;
  double num_trials_ = 0.0;
};

}  // namespace

void check_study_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  Rules(file, problems).run();
  check_session_rules(file, problems);
  check_label_rules(file, problems);
  check_task_rules(file, problems);
  check_timing_rules(file, problems);
  check_order_rules(file, problems);
  check_interleaved_rules(file, problems);
  check_sound_rules(file, problems);
  check_participant_field_rules(file, problems);
  check_design_rules(file, problems);
  check_sequential_rules(file, problems);
}

}  // namespace jnd::experiments
