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
  std::vector<AnsweredTrial> trials;  ///< In their order; the response as a session stores it.
  double felt_s = 0.0;  ///< In all presentations: no less than this do the trials take.
};

/// Answers of simulated participants without a device: the procedures draw, and the perceiver
/// reads, with the random numbers that a session of the same seed uses; but what a presentation
/// delivers is calculated (`calculated_stroke`). So where the force limiter keeps out of the
/// way, the same person gives nearly the same answers as in a whole simulated session. Some
/// microseconds a trial. Not real time; safe from several threads.
class AnswerSimulator {
 public:
  /// Both must outlive the simulator. Throws `Error` for a study whose answers it has no
  /// person for.
  AnswerSimulator(const Study& study, const Laboratory& laboratory);

  /// Every block of a participant's own list of stages, in its order. `session_seed` as in
  /// `session_seed` of experiments/session/session.h.
  [[nodiscard]] std::vector<AnsweredBlock> answers(const std::vector<StageInstance>& stages,
                                                   std::uint64_t session_seed) const;

 private:
  const Laboratory& laboratory_;
  const DeviceNeeds& device_;
  std::unique_ptr<const core::ForceMap> map_;
};

}  // namespace jnd::experiments
