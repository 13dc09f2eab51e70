#pragma once

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// The unit of the numbers in a magnitude estimation.
enum class Modulus {
  kWater,     ///< Percent of real water as it is remembered.
  kStandard,  ///< A standard that is felt counts as `modulus_value`.
  kFree,      ///< Each participant's own modulus.
};

/// Returns the modulus of a block of magnitude estimation.
[[nodiscard]] Modulus modulus_of(const Block& block);

/// Magnitude estimation (Stevens 1957): a stimulus, and a number for how strong it feels. Each
/// repetition shows every intensity once in random order. A standard is felt before the
/// stimulus of the first trial and of every `standard_every_trials`-th trial after it. Those
/// trials have it as their reference.
class MagnitudeEstimation final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override {
    return "magnitude_estimation";
  }
  [[nodiscard]] std::string title() const override {
    return core::for_people("Magnitude estimation");
  }
  [[nodiscard]] std::string words() const override {
    return core::for_people("magnitude estimation");
  }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] std::vector<std::string> examples() const override;
  [[nodiscard]] TrialForm form(const Block& block) const override;
  [[nodiscard]] Measure measures(const Block&) const override { return Measure::kMagnitude; }
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
};

}  // namespace jnd::experiments
