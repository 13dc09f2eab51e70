#include "experiments/procedures/constant_stimuli.h"

#include "experiments/procedures/repetitions.h"

namespace jnd::experiments {

std::string ConstantStimuli::meaning() const {
  return "A fixed set of test stimuli in random order, each with a question answered yes or "
         "no.";
}

std::vector<BlockKey> ConstantStimuli::keys() const {
  std::vector<BlockKey> keys = {stimuli_key(), task_key(), reference_key(), repetitions_key()};
  for (BlockKey& label : answer_label_keys()) keys.push_back(std::move(label));
  return keys;
}

TrialForm ConstantStimuli::form(const Block& block) const {
  return {.answer = AnswerKind::kYesNo, .has_reference = block.reference_intensity.has_value()};
}

std::vector<PlannedTrial> ConstantStimuli::draw_next(const Block& block,
                                                     const std::vector<AnsweredTrial>& answered,
                                                     core::RandomStream& stream) const {
  if (!answered.empty()) return {};
  return shuffled_repetitions(
      block.intensities, block.repetitions, stream, [&](int, double intensity) {
        return PlannedTrial{.intensity = intensity,
                            .reference_intensity = block.reference_intensity};
      });
}

int ConstantStimuli::expected_trials(const Block& block) const noexcept {
  return block.repetitions * static_cast<int>(block.intensities.size());
}

}  // namespace jnd::experiments
