#include "experiments/procedures/procedure_registry.h"

#include <string>

#include "core/error.h"
#include "experiments/procedures/constant_stimuli.h"
#include "experiments/procedures/limits_procedure.h"
#include "experiments/procedures/magnitude_estimation.h"
#include "experiments/procedures/magnitude_production.h"
#include "experiments/procedures/matching.h"
#include "experiments/procedures/quest_plus_procedure.h"
#include "experiments/procedures/rating.h"
#include "experiments/procedures/staircase_procedure.h"

namespace jnd::experiments {

const std::vector<const Procedure*>& procedures() {
  static const MagnitudeEstimation kMagnitudeEstimation;
  static const MagnitudeProduction kMagnitudeProduction;
  static const Matching kMatching;
  static const Rating kRating;
  static const ConstantStimuli kConstantStimuli;
  static const LimitsProcedure kLimits;
  static const StaircaseProcedure kStaircase;
  static const QuestPlusProcedure kQuestPlus;
  static const std::vector<const Procedure*> kAll = {&kMagnitudeEstimation,
                                                     &kMagnitudeProduction,
                                                     &kMatching,
                                                     &kRating,
                                                     &kConstantStimuli,
                                                     &kLimits,
                                                     &kStaircase,
                                                     &kQuestPlus};
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
