#pragma once

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Magnitude estimation (Stevens 1957): a stimulus, a number for how strong it feels. Each
/// repetition shows every intensity once in random order; the answer is in percent of a
/// standard that the study's instruction names.
class MagnitudeEstimation final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override {
    return "magnitude_estimation";
  }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] TrialForm form(const Block& block) const override;
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] int expected_trials(const Block& block) const noexcept override;
};

}  // namespace jnd::experiments
