#pragma once

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Method of adjustment. The standard is felt first, then the comparison, which the participant
/// has raised and lowered step by step until both feel alike, with free switching back and
/// forth. The standard is a medium of its own, or another amount of the block's medium. Each
/// repetition pairs every standard with every starting value once, in random order. The
/// standard is stored as reference_intensity in the unit of its medium; the response is the
/// comparison's intensity. Steps may leave the range of starting values.
class Matching final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "matching"; }
  [[nodiscard]] std::string title() const override { return core::for_people("Matching"); }
  [[nodiscard]] std::string words() const override {
    return core::for_people("matching by the method of adjustment");
  }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] std::vector<std::string> examples() const override;
  [[nodiscard]] TrialForm form(const Block& block) const override;
  [[nodiscard]] Measure measures(const Block&) const override { return Measure::kMatch; }
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
};

}  // namespace jnd::experiments
