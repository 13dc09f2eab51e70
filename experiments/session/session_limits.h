#pragma once

#include <string>
#include <vector>

#include "core/exposure.h"
#include "experiments/order/counterbalance.h"
#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Returns the number of answers since the last finished `break`, in any stage after it.
[[nodiscard]] int num_answers_since_break(const std::vector<const Stage*>& stages,
                                          const SessionState& state);

/// Returns what the experimenter is told when a session passes a limit of its study, such as
/// "62 trials without a break, of at most 60", or "" if it keeps within them. `elapsed_s` is
/// how long the session has taken so far.
[[nodiscard]] std::string limit_advice(const SessionLimits& limits, int num_answers_since_break,
                                       double elapsed_s);

/// Returns "12.0 min under force, of at most 10.0" for a hand that has reached the exposure
/// that its study allows, or "".
[[nodiscard]] std::string exposure_words(const SessionLimits& limits,
                                         const core::Exposure& exposure);

}  // namespace jnd::experiments
