#include "experiments/procedures/magnitude_production.h"

#include "experiments/procedures/repetitions.h"

namespace jnd::experiments {

TrialForm MagnitudeProduction::form() const noexcept {
  return {.answer = AnswerKind::kMatch, .adjustable = true};
}

std::vector<PlannedTrial> MagnitudeProduction::draw_next(
    const Block& block, const std::vector<AnsweredTrial>& answered,
    core::RandomStream& stream) const {
  if (!answered.empty()) return {};
  const int num_targets = static_cast<int>(block.target_percent.size());
  return shuffled_repetitions(
      block.intensities, num_targets * block.repetitions, stream,
      [&](int repetition, double start) {
        return PlannedTrial{
            .starting_intensity = start,
            .target_percent = block.target_percent[(repetition - 1) % num_targets]};
      });
}

int MagnitudeProduction::expected_trials(const Block& block) const noexcept {
  return block.repetitions *
         static_cast<int>(block.target_percent.size() * block.intensities.size());
}

}  // namespace jnd::experiments
