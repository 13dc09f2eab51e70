#pragma once

#include <string>

#include "experiments/adaptive/rule_outcome.h"

namespace jnd::analysis {

using experiments::AdaptiveTrack;
using experiments::LimitsEstimate;
using experiments::PosteriorEstimate;
using experiments::TrackPoint;

/// What a participant's answers in an adaptive block come to by the block's own rule, which
/// saw trials that were set aside later as well.
struct AdaptiveRun : experiments::RuleOutcome {
  std::string participant, block, procedure;
  int num_set_aside = 0;  ///< Trials; QUEST+ alone leaves them out.
  int num_after_end = 0;  ///< Trials that a correction put behind the end of the rule.
  std::string problem;    ///< Why nothing can be said; "" if it can.
};

}  // namespace jnd::analysis
