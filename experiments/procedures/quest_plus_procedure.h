#pragma once

#include "experiments/adaptive/quest_plus.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// QUEST+ (Watson 2017): each trial shows the stimulus whose answer is expected to tell most
/// about point of subjective equality and Weber fraction, or, in a yes-no task, about threshold
/// and slope. Grids that exclude what is asked for are refused: a pse away from the reference,
/// or fractions or thresholds that no stimulus shows.
class QuestPlusProcedure final : public Procedure {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "quest_plus"; }
  [[nodiscard]] std::string title() const override { return core::for_people("Quest plus"); }
  [[nodiscard]] std::string words() const override {
    return core::for_people("QUEST+ (Watson 2017)");
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
  [[nodiscard]] std::string caution(const Block& block,
                                    const std::vector<AnsweredTrial>& answered) const override;
  [[nodiscard]] AdaptiveRule rule() const noexcept override { return AdaptiveRule::kQuestPlus; }
  [[nodiscard]] RuleWords rule_words() const override;
  void run(const Block& block, const std::vector<LevelTrial>& trials,
           RuleOutcome& run) const override;
  [[nodiscard]] int expected_trials(const Block& block) const override;
};

/// Throws `Error` naming the keys that do not fit together.
[[nodiscard]] QuestPlusRule quest_plus_rule_of(const Block& block);

/// Returns the ends of grids that the posterior reaches, each with its key: "the lower end of
/// `pse_viscosity_pa_s` (12)". The estimates are those of one block.
[[nodiscard]] std::vector<std::string> reached_ends(
    const Block& block, const std::vector<QuestPlusEstimate>& estimates);

}  // namespace jnd::experiments
