#pragma once

#include "experiments/adaptive/method_of_limits.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Method of limits (Fechner 1860): the level rises, or falls, until the answer changes.
/// Ascending and descending series alternate.
class LimitsProcedure final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "limits"; }
  [[nodiscard]] std::string title() const override { return core::for_people("Limits"); }
  [[nodiscard]] std::string words() const override {
    return core::for_people("method of limits");
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
  void check(const Block& block) const override;
  [[nodiscard]] AdaptiveRule rule() const noexcept override { return AdaptiveRule::kLimits; }
  [[nodiscard]] RuleWords rule_words() const override;
  void run(const Block& block, const std::vector<LevelTrial>& trials,
           RuleOutcome& run) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
  [[nodiscard]] int most_trials(const Block& block) const noexcept override;
};

/// Throws `Error` naming the keys that do not fit together.
[[nodiscard]] LimitsRule limits_rule_of(const Block& block);

}  // namespace jnd::experiments
