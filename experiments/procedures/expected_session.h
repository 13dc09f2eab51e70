#pragma once

#include <vector>

#include "experiments/order/counterbalance.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Rough times for what a study gives none for, to plan the length of a session.
struct ExpectedTimes {
  double checklist_item_s = 20.0;
  double consent_paragraph_s = 30.0;
  double questionnaire_item_s = 15.0;
  double post_experiment_item_s = 45.0;
};

/// Returns how long this stage is expected to take, in seconds.
[[nodiscard]] double expected_duration_s(const Stage& stage, const ExpectedTimes& times = {});
/// Returns the same if the block of the stage has as many trials as possible.
[[nodiscard]] double longest_duration_s(const Stage& stage, const ExpectedTimes& times = {});

/// The largest number of trials from one `break` to the next, or to an end of the session.
struct Stretch {
  int num_trials = 0;                  ///< Expected number.
  std::vector<const Stage*> blocks{};  ///< Blocks of these trials.
};

/// Returns the longest stretch of a participant's own list of stages; the first one if several
/// are equally long.
[[nodiscard]] Stretch longest_stretch(const std::vector<StageInstance>& stages);

/// Returns how long a participant's own list of stages is expected to take, in seconds.
[[nodiscard]] double expected_session_s(const std::vector<StageInstance>& stages);

}  // namespace jnd::experiments
