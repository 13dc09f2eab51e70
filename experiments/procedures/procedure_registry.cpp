#include "experiments/procedures/procedure_registry.h"

#include <string>

#include "core/error.h"
#include "experiments/procedures/constant_stimuli.h"
#include "experiments/procedures/magnitude_estimation.h"
#include "experiments/procedures/magnitude_production.h"

namespace jnd::experiments {

const std::vector<const Procedure*>& procedures() {
  static const MagnitudeEstimation kMagnitudeEstimation;
  static const MagnitudeProduction kMagnitudeProduction;
  static const ConstantStimuli kConstantStimuli;
  static const std::vector<const Procedure*> kAll = {&kMagnitudeEstimation,
                                                     &kMagnitudeProduction, &kConstantStimuli};
  return kAll;
}

const Procedure& procedure_named(std::string_view name) {
  std::string known;
  for (const Procedure* procedure : procedures()) {
    if (procedure->name() == name) return *procedure;
    known += (known.empty() ? "" : ", ") + std::string(procedure->name());
  }
  throw core::Error("procedure: expected one of " + known + ", found " + std::string(name));
}

}  // namespace jnd::experiments
