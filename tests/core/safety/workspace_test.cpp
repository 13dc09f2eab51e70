#include "core/safety/workspace.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace jnd::core {
namespace workspace_test {

TEST(Workspace, IsABoxAboutTheOrigin) {
  const Workspace workspace{
      .half_width_x_m = 0.5, .half_width_y_m = 0.4, .half_width_z_m = 0.3};
  EXPECT_TRUE(workspace.contains({0.5, -0.4, 0.3}));
  EXPECT_FALSE(workspace.contains({-0.51, 0.0, 0.0}));
  EXPECT_FALSE(workspace.contains({0.0, 0.41, 0.0}));
  EXPECT_FALSE(workspace.contains({0.0, 0.0, -0.31}));
}

TEST(Workspace, ACoordinateThatIsNoNumberIsOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Workspace{}.contains({nan, 0.0, 0.0}));
  EXPECT_FALSE(Workspace{}.contains({0.0, nan, 0.0}));
  EXPECT_FALSE(Workspace{}.contains({0.0, 0.0, nan}));
}

TEST(Workspace, HasAnEnd) {
  EXPECT_NO_THROW(require_bounded(Workspace{}));
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(require_bounded({.half_width_x_m = wrong}), Error);
    EXPECT_THROW(require_bounded({.half_width_y_m = wrong}), Error);
    EXPECT_THROW(require_bounded({.half_width_z_m = wrong}), Error);
  }
}

}  // namespace workspace_test
}  // namespace jnd::core
