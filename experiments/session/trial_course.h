#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiments/procedures/procedure.h"
#include "experiments/session/session_state.h"

namespace jnd::experiments {

// What the stimuli of a trial's attempt have come to so far. Free space is none of them.

/// The first tick of the stimulus with which each of the trial's has been felt or is being
/// felt: from then on it can be answered, and time counts toward `answer_deadline_s`. None
/// before.
[[nodiscard]] std::optional<std::int64_t> asked_tick(const TrialForm& form,
                                                     const TrialState& trial);

/// Whether this was presented in the attempt: an interval as events name it, of three with its
/// place. Never of free space.
[[nodiscard]] bool was_presented(const TrialState& trial, const std::string& interval,
                                 std::int64_t place);

/// How often a stimulus was presented that had been presented before.
[[nodiscard]] int num_returns(const TrialState& trial);

}  // namespace jnd::experiments
