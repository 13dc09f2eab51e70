#include "experiments/procedures/magnitude_estimation.h"

#include "experiments/procedures/repetitions.h"

namespace jnd::experiments {

std::string MagnitudeEstimation::meaning() const {
  return "The participant says how strong each stimulus feels, in percent.";
}

std::vector<BlockKey> MagnitudeEstimation::keys() const {
  return {stimuli_key(), repetitions_key(), order_key()};
}

TrialForm MagnitudeEstimation::form(const Block&) const {
  return {.answer = AnswerKind::kPercent};
}

std::vector<PlannedTrial> MagnitudeEstimation::draw_next(
    const Block& block, const std::vector<AnsweredTrial>& answered,
    core::RandomStream& stream) const {
  if (!answered.empty()) return {};
  return ordered_repetitions(block, block.repetitions, stream, [](int, double intensity) {
    return PlannedTrial{.intensity = intensity};
  });
}

int MagnitudeEstimation::expected_trials(const Block& block) const noexcept {
  return block.repetitions * static_cast<int>(block.intensities.size());
}

}  // namespace jnd::experiments
