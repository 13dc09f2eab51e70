#pragma once

#include <cstdint>
#include <vector>

#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// How many answers a session has, and how many it will have in all of its blocks.
struct SessionCount {
  std::int64_t num_answers = 0;
  std::int64_t num_trials = 0;
  /// Answers still to come decide how many trials there will be.
  bool is_expected = false;
};

/// `stages` are those of the participant. Blocks that nobody has entered count as well. Not
/// real time.
[[nodiscard]] SessionCount count_of_session(
    const experiments::SessionState& state,
    const std::vector<const experiments::Stage*>& stages);

}  // namespace jnd::app
