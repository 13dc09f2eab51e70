#include "experiments/protocol/order_rules.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/protocol/stage_tables.h"
#include "experiments/protocol/study_check.h"
#include "experiments/study/order_table.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class OrderRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      if (word(stage, "kind") == "block") check_block(stage, pointer + "/order");
    });
  }

 private:
  /// What the order of a block is about. Only values that are valid by themselves are in it.
  struct Stimuli {
    std::string procedure, quantity;
    std::vector<double> values;
    double num_repetitions = 1.0;

    [[nodiscard]] std::string counted() const {
      return std::to_string(values.size()) + (values.size() == 1 ? " stimulus" : " stimuli");
    }
  };

  static Stimuli stimuli_of(const json& block) {
    Stimuli stimuli = {.procedure = word(block, "procedure"),
                       .quantity = quantity_of(word(block, "medium")),
                       .values = {}};
    const json& listed = list(block, stimuli.quantity);
    const Parameter* its = block_table().find(stimuli.quantity);
    // A list that is too long is reported as a whole.
    if (its == nullptr || listed.size() > its->max_items) return stimuli;
    for (const json& value : listed) {
      if (value.is_number()) stimuli.values.push_back(value.get<double>());
    }
    stimuli.num_repetitions = stimuli.procedure == "magnitude_production"
                                  ? static_cast<double>(list(block, "target_percent").size())
                                  : sound_number(block_table(), block, "repetitions", 1.0);
    return stimuli;
  }

  void check_block(const json& block, const std::string& pointer) {
    const json& order = object_at(block, "order");
    const Stimuli stimuli = stimuli_of(block);
    if (order.empty() || stimuli.values.empty()) return;
    if (block.contains("practice")) {
      report(pointer,
             "expected no order in a block that is `practice`, whose trials are drawn one by "
             "one, found one");
    }
    const std::string method = word(order, "method");
    if (method == "mixed") check_mixed(order, stimuli, pointer + "/method");
    if (method == "latin" || method == "williams") return;
    check_first(order, stimuli, pointer + "/not_first");
    check_distances(order, stimuli, pointer);
  }

  void check_mixed(const json& order, const Stimuli& stimuli, const std::string& pointer) {
    // Beyond this number, which no session reaches, orders can no longer be counted.
    constexpr double kMostTrials = 2000.0;
    if (stimuli.procedure == "magnitude_production") {
      report(pointer,
             "expected `shuffled`, `latin` or `williams`, as each repetition of "
             "`magnitude_production` has a target of its own, found `mixed`");
    }
    const double num_trials =
        static_cast<double>(stimuli.values.size()) * stimuli.num_repetitions;
    if (num_trials > kMostTrials && order.contains("max_in_a_row")) {
      report(pointer, "expected at most " + plain_number(kMostTrials) +
                          " trials to be mixed with `max_in_a_row`, found " +
                          plain_number(num_trials) + "; use `shuffled`");
    }
  }

  void check_first(const json& order, const Stimuli& stimuli, const std::string& pointer) {
    const json& not_first = list(order, "not_first");
    const auto& values = stimuli.values;
    for (std::size_t i = 0; i < not_first.size(); ++i) {
      if (!not_first[i].is_number() ||
          std::find(values.begin(), values.end(), not_first[i].get<double>()) != values.end()) {
        continue;
      }
      report(pointer + '/' + std::to_string(i), "expected one of the block's `" +
                                                    stimuli.quantity + "`, found " +
                                                    not_first[i].dump());
    }
    if (std::all_of(values.begin(), values.end(), [&](double value) {
          return std::find(not_first.begin(), not_first.end(), json(value)) != not_first.end();
        })) {
      report(pointer,
             "expected a stimulus left that the block can begin with, found all of its " +
                 stimuli.counted());
    }
  }

  void check_distances(const json& order, const Stimuli& stimuli, const std::string& pointer) {
    if (!(stimuli.num_repetitions > 1.0)) return;
    const auto num_stimuli = static_cast<double>(stimuli.values.size());
    const double distance = sound_number(order_table(), order, "min_distance", 1.0);
    if (distance > num_stimuli) {
      report(pointer + "/min_distance",
             "expected a number <= " + plain_number(num_stimuli) + ", as " + stimuli.counted() +
                 " cannot be ordered with " + plain_number(distance - 1.0) +
                 " others between two trials of one, found " + plain_number(distance));
    }
    const double in_a_row =
        sound_number(order_table(), order, "max_in_a_row", stimuli.num_repetitions);
    if (num_stimuli == 1.0 && in_a_row < stimuli.num_repetitions) {
      report(pointer + "/max_in_a_row",
             "expected a number >= " + plain_number(stimuli.num_repetitions) + ", as " +
                 stimuli.counted() +
                 " with so many trials cannot be ordered with fewer in a "
                 "row, found " +
                 plain_number(in_a_row));
    }
  }
};

}  // namespace

void check_order_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  OrderRules(file, problems).run();
}

}  // namespace jnd::experiments
