#pragma once

#include <string>
#include <vector>

#include "core/exposure.h"
#include "experiments/order/counterbalance.h"
#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Answers given since the last `break` that was finished, in any stage after it.
[[nodiscard]] int num_answers_since_break(const std::vector<const Stage*>& stages,
                                          const SessionState& state);

/// What the experimenter is told when a session under way passes a limit of its study: "62
/// trials without a break, of at most 60"; "" while it keeps to them. `elapsed_s`: how long the
/// session has taken so far.
[[nodiscard]] std::string limit_advice(const SessionLimits& limits, int num_answers_since_break,
                                       double elapsed_s);

/// "12.0 min under force, of at most 10.0" of a hand that has been exposed to all that its
/// study allows; "" before.
[[nodiscard]] std::string exposure_words(const SessionLimits& limits,
                                         const core::Exposure& exposure);

}  // namespace jnd::experiments
