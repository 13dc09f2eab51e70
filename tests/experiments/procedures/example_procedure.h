#pragma once

#include <algorithm>

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Presents the stimuli from the weakest up, each once, until two in a row are felt. This gives
/// a rough threshold in few trials.
class RoughThreshold final : public Procedure {
 public:
  std::string_view name() const noexcept override { return "rough_threshold"; }
  std::string words() const override { return "rough threshold"; }
  std::string meaning() const override {
    return "Stimuli from the weakest up, until two in a row are felt.";
  }
  std::vector<BlockKey> keys() const override { return {stimuli_key()}; }
  TrialForm form(const Block&) const override { return {.answer = AnswerKind::kYesNo}; }
  Measure measures(const Block&) const override { return Measure::kDetection; }
  bool adapts() const noexcept override { return true; }

  std::vector<PlannedTrial> draw_next(const Block& block,
                                      const std::vector<AnsweredTrial>& answered,
                                      core::RandomStream&) const override {
    const std::size_t num = answered.size();
    const bool is_found =
        num >= 2 && answered[num - 1].response == 1.0 && answered[num - 2].response == 1.0;
    if (is_found || num == block.intensities.size()) return {};
    std::vector<double> ascending = block.intensities;
    std::ranges::sort(ascending);
    return {{.position = static_cast<int>(num) + 1, .intensity = ascending[num]}};
  }

  int expected_trials(const Block& block) const noexcept override {
    return static_cast<int>(block.intensities.size() / 2 + 1);
  }
};

}  // namespace jnd::experiments
