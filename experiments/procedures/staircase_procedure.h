#pragma once

#include "experiments/adaptive/staircase.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// One or several interleaved staircases (Levitt 1971; weighted: Kaernbach 1991), one for each
/// starting level. "Yes" lowers the level: the test was more than the reference, or was felt.
class StaircaseProcedure final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "staircase"; }
  [[nodiscard]] std::string title() const override { return core::for_people("Staircase"); }
  [[nodiscard]] std::string words() const override { return core::for_people("staircase"); }
  [[nodiscard]] std::string meaning() const override;
  [[nodiscard]] std::vector<BlockKey> keys() const override;
  [[nodiscard]] std::vector<std::string> examples() const override;
  [[nodiscard]] TrialForm form(const Block& block) const override;
  [[nodiscard]] Measure measures(const Block& block) const override;
  [[nodiscard]] std::vector<PlannedTrial> draw_next(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream) const override;
  [[nodiscard]] std::vector<double> possible_intensities(const Block& block) const override;
  [[nodiscard]] std::optional<double> right_response(const Block& block,
                                                     const PlannedTrial& trial) const override;
  [[nodiscard]] std::optional<double> feedback_response(
      const Block& block, const PlannedTrial& trial) const override;
  void check(const Block& block) const override;
  [[nodiscard]] AdaptiveRule rule() const noexcept override { return AdaptiveRule::kStaircase; }
  [[nodiscard]] RuleWords rule_words() const override;
  void run(const Block& block, const std::vector<LevelTrial>& trials,
           RuleOutcome& run) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
  [[nodiscard]] int most_trials(const Block& block) const noexcept override;
};

/// Returns the rule of the staircase that starts at the block's `series`-th starting level,
/// from 1. Throws `Error` naming the keys that do not fit together.
[[nodiscard]] StaircaseRule staircase_rule_of(const Block& block, int series);

}  // namespace jnd::experiments
