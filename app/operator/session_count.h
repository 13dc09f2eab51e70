#pragma once

#include <cstdint>
#include <vector>

#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// Answers of a session among all that it will have, in every one of its blocks.
struct SessionCount {
  std::int64_t num_answers = 0;
  std::int64_t num_trials = 0;
  bool is_expected = false;  ///< The answers of a block to come decide how many there will be.
};

/// `stages`: the participant's own. Blocks that nobody has entered count as well. Not real
/// time.
[[nodiscard]] SessionCount count_of_session(
    const experiments::SessionState& state,
    const std::vector<const experiments::Stage*>& stages);

}  // namespace jnd::app
