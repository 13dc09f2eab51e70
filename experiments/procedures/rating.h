#pragma once

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Category rating: each stimulus is assigned to a step of a scale whose ends have labels.
/// There is no standard and no modulus. Every stimulus comes once in each repetition. The
/// response is the step, from 1.
class Rating final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "rating"; }
  [[nodiscard]] std::string title() const override { return core::for_people("Rating"); }
  [[nodiscard]] std::string words() const override {
    return core::for_people("rating on a scale");
  }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] std::vector<std::string> examples() const override;
  [[nodiscard]] TrialForm form(const Block&) const override {
    return {.answer = AnswerKind::kStep};
  }
  [[nodiscard]] Measure measures(const Block&) const override { return Measure::kRating; }
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
};

/// Returns the last step of the scale of a rating block.
[[nodiscard]] int num_steps_of(const Block& block);

}  // namespace jnd::experiments
