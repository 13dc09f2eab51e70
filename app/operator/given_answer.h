#pragma once

#include <cstdint>
#include <optional>

#include "app/operator/answer_doubts.h"
#include "experiments/procedures/procedure.h"
#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What the log does not say yet of the presentation that is under way.
struct FeltSoFar {
  std::int64_t num_strokes = 0;  ///< Whole ones.
  std::int64_t next_tick = 0;    ///< The first that was not felt.
};

/// What speaks for or against an answer, as far as the log of its session knows.
struct AnswerGiven {
  const experiments::SessionState& state;
  const experiments::TrialState& trial;  ///< Of `state`.
  const experiments::Block& block;       ///< Of the trial.
  double rate_hz = 1000.0;               ///< Of the session's loop.
  bool hides_levels = false;  ///< Nothing is said of the movement, which could tell them.
  FeltSoFar felt{};           ///< Of a trial under way.

  /// `value`: as in `GivenAnswer`.
  [[nodiscard]] GivenAnswer with(experiments::AnswerKind kind,
                                 const std::optional<double>& value) const;
};

}  // namespace jnd::app
