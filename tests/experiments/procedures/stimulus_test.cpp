#include "experiments/procedures/stimulus.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace stimulus_test {

TEST(Stimulus, EveryMediumOfTheTableHasItsAmounts) {
  for (const Medium& medium : media()) {
    const core::MediumAmounts amounts = amounts_of(medium.name, 2.0);
    bool is_something = false;
    for (const auto amount : core::kAmounts) is_something |= amounts.*amount != 0.0;
    EXPECT_EQ(is_something, !medium.quantity.empty()) << medium.name;
  }
}

TEST(Stimulus, TheMediaAreTheirLaws) {
  EXPECT_EQ(amounts_of("water", 2.0).quadratic_kg_per_m,
            core::water({.scale = 2.0}).quadratic_kg_per_m);
  const core::MediumAmounts mapped = amounts_of("water_map", 2.0);
  EXPECT_EQ(mapped.mapped_drag_kg_per_m, amounts_of("water", 2.0).quadratic_kg_per_m);
  EXPECT_EQ(mapped.lift_kg_per_m, mapped.mapped_drag_kg_per_m);
  EXPECT_EQ(amounts_of("viscous", 5.0).inertial_n, 0.0);
  EXPECT_GT(amounts_of("viscous_schiller_naumann", 5.0).inertial_n, 0.0);
  EXPECT_GT(amounts_of("viscous_ellipsoid", 5.0).ellipsoid_normal_n_s_per_m, 0.0);
}

TEST(Stimulus, BuoyancyAndFrictionComeOnTop) {
  const core::MediumAmounts buoyant = amounts_of({.medium = "viscous",
                                                  .quantity = "viscosity_pa_s",
                                                  .intensity = 5.0,
                                                  .details = {{"buoyancy_n", 3.0}}});
  EXPECT_EQ(buoyant.buoyancy_n, 3.0);
  EXPECT_EQ(buoyant.damping_n_s_per_m, amounts_of("viscous", 5.0).damping_n_s_per_m);
  const core::MediumAmounts rough = amounts_of({.medium = "solid",
                                                .quantity = "stiffness_n_per_m",
                                                .intensity = 1000.0,
                                                .details = {{"friction_ratio", 0.4}}});
  EXPECT_NEAR(rough.plane_friction_n_per_m, 400.0, 1e-9);
  EXPECT_EQ(amounts_of("solid", 1000.0).plane_friction_n_per_m, 0.0);
}

TEST(Stimulus, TheSphereOfAStudyFileHasItsStokesDrag) {
  const auto force_n = [](const std::string& radius) {
    const Study study = read_study_text(
        R"json({"format": 1, "name": "tool", "languages": ["en"], "title": {"en": "Tool"},
  "authors": ["A. Author"], "stages": [{"kind": "block", "name": "tip",
  "medium": "viscous_sphere", )json" +
            radius + R"json("instruction": {"en": "Stir."}, "question": {"en": "Thicker?"},
  "expected_trial_s": 10, "procedure": "constant_stimuli", "viscosity_pa_s": [2, 5],
  "reference_viscosity_pa_s": 4, "repetitions": 1}]})json",
        "s.json");
    const auto& block = std::get<Block>(study.stages.front().content);
    return amounts_of(setting_of(block, "test", 2.0)).drag_n({.speed_m_per_s = 0.5});
  };
  // Stokes: 6 pi radius viscosity speed, here 6 pi 0.02 m 2 Pa s 0.5 m/s.
  EXPECT_NEAR(force_n(R"("sphere_radius_m": 0.02, )"), 0.3769911, 1e-6);
  EXPECT_NEAR(force_n(""), 0.1884956, 1e-6) << "a tip of 0.01 m unless the study says so";
}

TEST(Stimulus, OfABlockIsItsMediumOrFreeSpace) {
  Block block;
  block.medium = "viscous";
  block.quantity = "viscosity_pa_s";
  block.details = {{"buoyancy_n", 2.0}};
  EXPECT_EQ(setting_of(block, "reference", 4.0).intensity, 4.0);
  EXPECT_EQ(setting_of(block, "test", 4.0).details, block.details);
  EXPECT_EQ(setting_of(block, "free_space", 4.0).medium, "free_space");
  EXPECT_EQ(amounts_of(setting_of(block, "free_space", 4.0)).buoyancy_n, 0.0);
}

TEST(Stimulus, TheContainerAndTheMapAreTheStudys) {
  DeviceNeeds needs;
  EXPECT_FALSE(surroundings_of(needs).container().is_there());
  EXPECT_EQ(force_map_of(needs), nullptr);
  needs.wall_stiffness_n_per_m = 800.0;
  needs.wall_friction_ratio = 0.5;
  needs.force_map = {{0.0, 1.0, 0.2, 0.0}, {1.5, 1.0, 0.8, 0.0}};
  EXPECT_EQ(surroundings_of(needs).container_stiffness_n_per_m, 800.0);
  EXPECT_GT(surroundings_of(needs).container_damping_n_s_per_m, 0.0);
  EXPECT_NEAR(surroundings_of(needs).container_friction_n_per_m, 400.0, 1e-9);
  EXPECT_NEAR(force_map_of(needs)->at(1.5, 0.1).drag, 0.8, 1e-12);
}

TEST(Stimulus, SaysWhichMediaThereAre) {
  try {
    static_cast<void>(amounts_of("honey", 1.0));
    FAIL();
  } catch (const core::Error& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("`viscous_ellipsoid`"), std::string::npos) << words;
    EXPECT_NE(words.find("found `honey`"), std::string::npos) << words;
  }
}

}  // namespace stimulus_test
}  // namespace jnd::experiments
