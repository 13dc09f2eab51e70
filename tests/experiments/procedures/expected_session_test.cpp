#include "experiments/procedures/expected_session.h"

#include <gtest/gtest.h>

namespace jnd::experiments {
namespace expected_session_test {

Stage block(const std::string& name, int num_stimuli) {
  Stage stage;
  stage.name = name;
  stage.content =
      Block{.procedure = "magnitude_estimation",
            .intensities = std::vector<double>(static_cast<std::size_t>(num_stimuli)),
            .repetitions = 2,
            .free_space_between_s = 2.0,
            .expected_trial_s = 8.0};
  return stage;
}

Stage rest() {
  Stage stage;
  stage.name = "rest";
  stage.content = Break{.instruction = {}, .duration_s = 60.0};
  return stage;
}

const std::vector<Stage> kStages = {block("first", 10), rest(), block("second", 6),
                                    block("third", 5), rest()};

TEST(ExpectedSession, TrialsCountFromBreakToBreakOverBlocks) {
  std::vector<StageInstance> stages;
  for (const Stage& stage : kStages) stages.push_back({&stage, stage.name});
  const Stretch longest = longest_stretch(stages);
  // (6 + 5) stimuli come twice, which is more than 10 twice.
  EXPECT_EQ(longest.num_trials, 22);
  ASSERT_EQ(longest.blocks.size(), 2U);
  EXPECT_EQ(longest.blocks[0]->name, "second");
  EXPECT_EQ(longest.blocks[1]->name, "third");
  EXPECT_EQ(longest_stretch({}).num_trials, 0);
}

TEST(ExpectedSession, ASessionTakesItsStagesTogether) {
  std::vector<StageInstance> stages;
  for (const Stage& stage : kStages) stages.push_back({&stage, stage.name});
  EXPECT_DOUBLE_EQ(expected_session_s(stages), 2 * (10 + 6 + 5) * 10.0 + 2 * 60.0);
}

}  // namespace expected_session_test
}  // namespace jnd::experiments
