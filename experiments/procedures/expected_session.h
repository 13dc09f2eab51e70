#pragma once

#include <vector>

#include "experiments/order/counterbalance.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Rough times for what a study gives none for. Only for planning the length of a session.
struct ExpectedTimes {
  double checklist_item_s = 20.0;
  double consent_paragraph_s = 30.0;
  double questionnaire_item_s = 15.0;
  double post_experiment_item_s = 45.0;
};

/// How long this stage is expected to take, in seconds.
[[nodiscard]] double expected_duration_s(const Stage& stage, const ExpectedTimes& times = {});
/// The same of a stage whose block has all trials that it can have.
[[nodiscard]] double longest_duration_s(const Stage& stage, const ExpectedTimes& times = {});

/// The most trials that somebody does from one `break` to the next, or to an end of the
/// session.
struct Stretch {
  int num_trials = 0;                  ///< To be expected.
  std::vector<const Stage*> blocks{};  ///< That they are of.
};

/// Of a participant's own list of stages; the first of those that are equally long.
[[nodiscard]] Stretch longest_stretch(const std::vector<StageInstance>& stages);

/// How long a participant's own list of stages is expected to take, in seconds.
[[nodiscard]] double expected_session_s(const std::vector<StageInstance>& stages);

}  // namespace jnd::experiments
