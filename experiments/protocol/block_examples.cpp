#include "experiments/protocol/block_examples.h"

#include "experiments/procedures/procedure_registry.h"

namespace jnd::experiments {

const std::vector<BlockExample>& block_examples() {
  static const std::vector<BlockExample> kExamples = [] {
    std::vector<BlockExample> examples;
    for (const Procedure* procedure : procedures()) {
      for (const std::string& json : procedure->examples()) {
        examples.push_back({std::string(procedure->name()), json});
      }
    }
    return examples;
  }();
  return kExamples;
}

}  // namespace jnd::experiments
