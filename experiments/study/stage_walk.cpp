#include "experiments/study/stage_walk.h"

#include "experiments/study/rule_values.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

void walk(const json& stages, const std::string& pointer,
          const std::function<void(const json&, const std::string&)>& visit) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (!stages[i].is_object()) continue;
    const std::string here = pointer + '/' + std::to_string(i);
    visit(stages[i], here);
    const json& arms = list(stages[i], "arms");
    for (std::size_t arm = 0; arm < arms.size(); ++arm) {
      walk(list(arms[arm], "stages"), here + "/arms/" + std::to_string(arm) + "/stages", visit);
    }
    walk(list(stages[i], "between"), here + "/between", visit);
    walk(list(stages[i], "blocks"), here + "/blocks", visit);
  }
}

}  // namespace

void for_each_written_stage(
    const json& root,
    const std::function<void(const json& stage, const std::string& pointer)>& visit) {
  walk(list(root, "stages"), "/stages", visit);
}

void for_each_stage(const std::vector<Stage>& stages,
                    const std::function<void(const Stage& stage)>& visit) {
  for (const Stage& stage : stages) {
    visit(stage);
    const auto* counterbalance = std::get_if<Counterbalance>(&stage.content);
    if (counterbalance == nullptr) continue;
    for (const Counterbalance::Arm& arm : counterbalance->arms) {
      for_each_stage(arm.stages, visit);
    }
    for_each_stage(counterbalance->between, visit);
  }
}

}  // namespace jnd::experiments
