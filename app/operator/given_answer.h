#pragma once

#include <cstdint>
#include <optional>

#include "app/operator/answer_doubts.h"
#include "experiments/procedures/procedure.h"
#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What the log does not yet say about the presentation that is under way.
struct FeltSoFar {
  std::int64_t num_strokes = 0;  ///< Whole strokes only.
  std::int64_t next_tick = 0;    ///< The first tick that was not felt.
};

/// An answer's circumstances, as far as the log of its session knows them.
struct AnswerGiven {
  const experiments::SessionState& state;
  const experiments::TrialState& trial;  ///< Part of `state`.
  const experiments::Block& block;       ///< The trial's block.
  double rate_hz = 1000.0;               ///< The rate of the session's loop.
  /// Nothing is said about movement, which could tell the levels.
  bool hides_levels = false;
  FeltSoFar felt{};  ///< Only for a trial under way.

  /// `value` is as in `GivenAnswer`.
  [[nodiscard]] GivenAnswer with(experiments::AnswerKind kind,
                                 const std::optional<double>& value) const;
};

}  // namespace jnd::app
