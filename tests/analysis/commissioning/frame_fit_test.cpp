#include "analysis/commissioning/frame_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace frame_fit_test {

const std::vector<Eigen::Vector3d> kMarks = {{-0.1, -0.1, -0.25}, {0.1, -0.1, -0.25},
                                             {-0.1, 0.1, -0.25},  {0.1, 0.1, -0.05},
                                             {-0.1, 0.1, -0.05},  {0.1, -0.1, -0.05}};

std::vector<TouchedMark> touched(const Eigen::Matrix3d& rotation,
                                 const Eigen::Vector3d& offset_m, double sd_m,
                                 core::RandomStream& random) {
  std::vector<TouchedMark> marks;
  for (const Eigen::Vector3d& mark_m : kMarks) {
    const Eigen::Vector3d met_m =
        mark_m + Eigen::Vector3d(random.normal(0.0, sd_m), random.normal(0.0, sd_m),
                                 random.normal(0.0, sd_m));
    marks.push_back(
        {.device_m = rotation.transpose() * (met_m - offset_m), .workspace_m = mark_m});
  }
  return marks;
}

TEST(FrameFit, FindsAQuarterTurnExactly) {
  // The device's x axis is the workspace's y axis.
  Eigen::Matrix3d rotation;
  rotation << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const Eigen::Vector3d offset_m(0.3, -0.2, 0.05);
  core::RandomStream random(1, "frame");
  const FrameFit fit = fit_frame(touched(rotation, offset_m, 0.0, random));
  EXPECT_TRUE(fit.rotation.isApprox(rotation, 1e-12));
  EXPECT_TRUE(fit.offset_m.isApprox(offset_m, 1e-12));
  EXPECT_NEAR(fit.residual_m, 0.0, 1e-12);
}

TEST(FrameFit, IsNeverAMirror) {
  // Marks in a plane fit a reflection as well as a rotation.
  std::vector<TouchedMark> marks;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.1, 0.0),
                                    Eigen::Vector2d(0.0, 0.1), Eigen::Vector2d(0.1, 0.1)}) {
    marks.push_back({.device_m = {at.y(), at.x(), 0.0}, .workspace_m = {at.x(), at.y(), 0.0}});
  }
  EXPECT_NEAR(fit_frame(marks).rotation.determinant(), 1.0, 1e-12);
}

TEST(FrameFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kStudies = 2000;
  constexpr double kSd_m = 0.0003;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d offset_m(0.2, 0.4, -0.1);
  core::RandomStream random(5, "frame");
  int num_turns_held = 0, num_offsets_held = 0;
  for (int study = 0; study < kStudies; ++study) {
    const FrameFit fit = fit_frame(touched(rotation, offset_m, kSd_m, random));
    const Eigen::AngleAxisd between(fit.rotation * rotation.transpose());
    const Eigen::Vector3d turn_rad = between.angle() * between.axis();
    const Eigen::Vector3d shift_m = fit.offset_m - offset_m;
    for (int axis = 0; axis < 3; ++axis) {
      num_turns_held += std::abs(turn_rad[axis]) <= fit.rotation_ci95_rad[axis] ? 1 : 0;
      num_offsets_held += std::abs(shift_m[axis]) <= fit.offset_ci95_m[axis] ? 1 : 0;
    }
  }
  EXPECT_NEAR(num_turns_held / (3.0 * kStudies), 0.95, 0.012);
  EXPECT_NEAR(num_offsets_held / (3.0 * kStudies), 0.95, 0.012);
}

TEST(FrameFit, TooFewMarksAndMarksOnALineAreRefused) {
  core::RandomStream random(1, "frame");
  std::vector<TouchedMark> marks =
      touched(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 0.0, random);
  marks.resize(3);
  EXPECT_THROW((void)fit_frame(marks), core::Error);
  std::vector<TouchedMark> line;
  for (const double x : {0.0, 0.1, 0.2, 0.3, 0.5}) {
    line.push_back(
        {.device_m = {x, 0.001 * x * x, 0.0}, .workspace_m = {x, 0.001 * x * x, 0.0}});
  }
  EXPECT_THROW((void)fit_frame(line), core::Error);
}

}  // namespace frame_fit_test
}  // namespace jnd::analysis
