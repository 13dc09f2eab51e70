#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiments/procedures/procedure.h"
#include "experiments/session/session_state.h"

namespace jnd::experiments {

// What has been presented in a trial's attempt so far. Free space does not count.

/// Returns the first tick of the stimulus with which every stimulus of the trial has been felt
/// or is being felt. From then on the trial can be answered, and time counts towards
/// `answer_deadline_s`. None before.
[[nodiscard]] std::optional<std::int64_t> asked_tick(const TrialForm& form,
                                                     const TrialState& trial);

/// Whether this interval, as events name it, was presented in the attempt. One of three
/// intervals is given with its place. False for free space.
[[nodiscard]] bool was_presented(const TrialState& trial, const std::string& interval,
                                 std::int64_t place);

/// Returns how often a stimulus was presented that had been presented before.
[[nodiscard]] int num_returns(const TrialState& trial);

}  // namespace jnd::experiments
