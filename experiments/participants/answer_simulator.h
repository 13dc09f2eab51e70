#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/media/force_map.h"
#include "experiments/order/counterbalance.h"
#include "experiments/participants/simulated_participant.h"
#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// A block with the answers of one simulated participant.
struct AnsweredBlock {
  const Stage* stage = nullptr;
  std::vector<AnsweredTrial> trials;  ///< In order, with responses as a session stores them.
  double felt_s = 0.0;  ///< Duration of all presentations. The trials take at least this long.
};

/// Computes the answers of simulated participants without a device. The procedures draw and the
/// perceiver reads with the random numbers of a session with the same seed, but what a
/// presentation delivers is calculated (`calculated_stroke`). So while the force limiter does
/// not act, a person gives nearly the same answers as in a complete simulated session. A trial
/// takes some microseconds. Not real time; several threads may call it.
class AnswerSimulator {
 public:
  /// Both must outlive the simulator. Throws `Error` for a study whose questions its simulated
  /// people cannot answer.
  AnswerSimulator(const Study& study, const Laboratory& laboratory);

  /// Returns every block of a participant's own list of stages, in order. `session_seed` is as
  /// in `session_seed` of experiments/session/session.h.
  [[nodiscard]] std::vector<AnsweredBlock> answers(const std::vector<StageInstance>& stages,
                                                   std::uint64_t session_seed) const;

 private:
  const Laboratory& laboratory_;
  const DeviceNeeds& device_;
  std::unique_ptr<const core::ForceMap> map_;
};

}  // namespace jnd::experiments
