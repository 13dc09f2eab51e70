#pragma once

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Method of constant stimuli, with free switching between the stimuli of a trial. In a
/// reminder task the reference comes first, then the test, with a yes/no question about it.
/// (This is no 2AFC, because the order is fixed.) `Task` describes the others. Each repetition
/// shows every test once in random order, with its catch trials at random places.
class ConstantStimuli final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "constant_stimuli"; }
  [[nodiscard]] std::string title() const override {
    return core::for_people("Constant stimuli");
  }
  [[nodiscard]] std::string words() const override {
    return core::for_people("method of constant stimuli");
  }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] std::vector<std::string> examples() const override;
  [[nodiscard]] TrialForm form(const Block& block) const override;
  [[nodiscard]] Measure measures(const Block& block) const override;
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] std::optional<double> right_response(const Block& block,
                                                     const PlannedTrial& trial) const override;
  [[nodiscard]] std::optional<double> feedback_response(
      const Block& block, const PlannedTrial& trial) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
};

}  // namespace jnd::experiments
