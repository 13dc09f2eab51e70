#pragma once

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Magnitude production (Stevens 1957): the participant has the intensity raised and lowered,
/// step by step, until it feels like the target. There is one repetition for each target, in
/// the study's order. It has every starting value once, in random order. Steps may leave the
/// range of starting values.
class MagnitudeProduction final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override {
    return "magnitude_production";
  }
  [[nodiscard]] std::string title() const override {
    return core::for_people("Magnitude production");
  }
  [[nodiscard]] std::string words() const override {
    return core::for_people("magnitude production");
  }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] std::vector<std::string> examples() const override;
  [[nodiscard]] TrialForm form(const Block& block) const override;
  [[nodiscard]] Measure measures(const Block&) const override {
    return Measure::kProducedMagnitude;
  }
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
};

}  // namespace jnd::experiments
