#include "device/exoskeleton/mujoco_guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <limits>

#include "core/error.h"

namespace jnd::device {
namespace mujoco_guard_test {

constexpr const char* kPendulum = R"(<mujoco><worldbody><body><joint type="hinge" axis="0 1 0"/>
  <inertial pos="0 0 -1" mass="1" diaginertia="0.1 0.1 0.1"/></body></worldbody></mujoco>)";

TEST(MujocoGuard, TellsInMujocosWordsWhatIsWrongWithAModel) {
  try {
    (void)load_mujoco_model("<mujoco><worldbody><bodyy/></worldbody></mujoco>");
    FAIL() << "such a model must not load";
  } catch (const core::Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("bodyy"));
  }
  EXPECT_THROW((void)load_mujoco_model("no model at all"), core::Error);
  EXPECT_THROW((void)load_mujoco_model(""), core::Error);
}

TEST(MujocoGuard, AStepThatMeetsWhatIsNoNumberSaysSoAndWritesNoFile) {
  const MujocoModel model = load_mujoco_model(kPendulum);
  const MujocoData data = make_mujoco_data(*model);
  EXPECT_TRUE(step_mujoco(*model, *data));
  data->qfrc_applied[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(step_mujoco(*model, *data));
  data->qfrc_applied[0] = 0.0;
  EXPECT_FALSE(step_mujoco(*model, *data)) << "for it has started the world afresh by itself";
  mj_resetData(model.get(), data.get());
  EXPECT_TRUE(step_mujoco(*model, *data));
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(MujocoGuard, AnErrorInAStepDoesNotEndTheProcess) {
  const MujocoModel model = load_mujoco_model(kPendulum);
  const MujocoData data = make_mujoco_data(*model);
  const int room = data->nstack;
  data->nstack = 0;  // Without this room, MuJoCo cannot compute anything.
  EXPECT_FALSE(step_mujoco(*model, *data));
  data->nstack = room;
  mj_resetData(model.get(), data.get());
  EXPECT_TRUE(step_mujoco(*model, *data));
}

}  // namespace mujoco_guard_test
}  // namespace jnd::device
