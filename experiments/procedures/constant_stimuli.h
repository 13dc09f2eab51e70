#pragma once

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Method of constant stimuli with a reminder: the reference first, then the test, with free
/// switching back, and a yes/no question about the test. (With the reference always first this
/// is a reminder task, not 2AFC.) In a yes-no task the test stands alone. Each repetition shows
/// every test once in random order.
class ConstantStimuli final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "constant_stimuli"; }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] TrialForm form(const Block& block) const override;
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] int expected_trials(const Block& block) const noexcept override;
};

}  // namespace jnd::experiments
