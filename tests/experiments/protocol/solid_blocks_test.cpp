#include <gtest/gtest.h>

#include <map>

#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"

namespace jnd::experiments {
namespace solid_blocks_test {

std::string study_with(const std::string& keys) {
  return R"json({"format": 1, "name": "solid", "languages": ["en"], "title": {"en": "Solid"},
  "authors": ["A. Author"], "stages": [{"kind": "block", "name": "stiff", "medium": "solid",
  "instruction": {"en": "Press."}, "question": {"en": "Stiffer?"}, "expected_trial_s": 10, )json" +
         keys + "}]}";
}

/// The further keys that each procedure asks for.
const std::map<std::string, std::string> kKeys = {
    {"constant_stimuli",
     R"("stiffness_n_per_m": [200, 300, 500], "reference_stiffness_n_per_m": 300,
        "repetitions": 2)"},
    {"limits", R"("stiffness_n_per_m": [200, 300, 400, 500],
        "reference_stiffness_n_per_m": 300, "num_series": 4)"},
    {"staircase",
     R"("start_stiffness_n_per_m": [600], "lowest_stiffness_n_per_m": 100,
        "highest_stiffness_n_per_m": 900, "reference_stiffness_n_per_m": 300,
        "step_ratio": [1.3])"},
    {"quest_plus",
     R"("stiffness_n_per_m": [200, 300, 400], "reference_stiffness_n_per_m": 300,
        "pse_stiffness_n_per_m": [200, 400])"},
    {"magnitude_estimation",
     R"("stiffness_n_per_m": [200, 400], "repetitions": 1, "modulus": "free")"},
    {"magnitude_production",
     R"("stiffness_n_per_m": [200, 400], "target_percent": [100],
        "coarse_step_stiffness_n_per_m": 100, "fine_step_stiffness_n_per_m": 20)"},
    {"rating",
     R"("stiffness_n_per_m": [200, 400], "repetitions": 1, "low_label": {"en": "soft"},
        "high_label": {"en": "hard"})"},
    {"matching",
     R"("stiffness_n_per_m": [200, 400], "standard_medium": "solid",
        "standard_stiffness_n_per_m": [300], "repetitions": 1,
        "coarse_step_stiffness_n_per_m": 100, "fine_step_stiffness_n_per_m": 20)"}};

TEST(SolidBlocks, EveryProcedureCanAskAboutStiffness) {
  for (const Procedure* procedure : procedures()) {
    const std::string name(procedure->name());
    ASSERT_TRUE(kKeys.contains(name)) << name;
    const std::string text = study_with(R"("procedure": ")" + name + R"(", )" + kKeys.at(name));
    ASSERT_TRUE(study_text_problems(text, "s.json").empty())
        << name << ": " << to_string(study_text_problems(text, "s.json").front());
    const Study study = read_study_text(text, "s.json");
    const Block& block = std::get<Block>(study.stages.front().content);
    EXPECT_TRUE(block.is_pressed());
    EXPECT_EQ(block.quantity, "stiffness_n_per_m");
    core::RandomStream stream(1, "order");
    EXPECT_FALSE(procedure->draw_next(block, {}, stream).empty()) << name;
  }
}

TEST(SolidBlocks, NoProcedureThatAdaptsCanAskWhetherTwoAreTheSame) {
  int num_refused = 0;
  for (const Procedure* procedure : procedures()) {
    if (!procedure->adapts()) continue;
    const std::string name(procedure->name());
    const std::vector<StudyProblem> problems =
        study_text_problems(study_with(R"("task": "same_different", "procedure": ")" + name +
                                       R"(", )" + kKeys.at(name)),
                            "s.json");
    ASSERT_FALSE(problems.empty()) << name;
    EXPECT_NE(to_string(problems.front()).find("cannot follow how often the same"),
              std::string::npos)
        << to_string(problems.front());
    ++num_refused;
  }
  EXPECT_GE(num_refused, 3);
}

TEST(SolidBlocks, TheSurfaceHasTheBlocksFriction) {
  const Study study =
      read_study_text(study_with(R"("procedure": "constant_stimuli", "friction_ratio": 0.3, )" +
                                 kKeys.at("constant_stimuli")),
                      "s.json");
  const Block& block = std::get<Block>(study.stages.front().content);
  const core::MediumAmounts amounts = amounts_of(setting_of(block, "test", 200.0));
  EXPECT_EQ(amounts.plane_stiffness_n_per_m, 200.0);
  EXPECT_EQ(amounts.plane_friction_n_per_m, 60.0);
  EXPECT_EQ(amounts_of(setting_of(block, "free_space", 0.0)).plane_stiffness_n_per_m, 0.0);
}

TEST(SolidBlocks, TheRangeTellsWhatTheDeviceCannotRender) {
  const Study study = read_study_text(
      study_with(R"("procedure": "constant_stimuli", "stiffness_n_per_m": [200, 50000],
                    "reference_stiffness_n_per_m": 300, "repetitions": 1)"),
      "s.json");
  std::map<double, bool> fits;
  for (const RangeEntry& entry :
       planned_range(study, {.max_force_per_point_n = 10.0, .max_total_force_n = 30.0})) {
    fits[entry.setting.intensity] = entry.fits;
  }
  EXPECT_TRUE(fits.at(200.0));
  EXPECT_FALSE(fits.at(50000.0));
}

}  // namespace solid_blocks_test
}  // namespace jnd::experiments
