#include "analysis/commissioning/frame_fit.h"

#include <Eigen/Dense>
#include <cmath>

#include "analysis/commissioning/measured.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr int kFewestMarks = 4;
/// The second largest extent divided by the largest. Below this value the marks practically lie
/// on a line.
constexpr double kLeastBreadthRatio = 0.05;

/// The matrix M for which M b = a x b.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

}  // namespace

FrameFit fit_frame(const std::vector<TouchedMark>& marks) {
  const auto num_marks = static_cast<int>(marks.size());
  if (num_marks < kFewestMarks) {
    throw core::Error("frame: expected at least 4 marks that were touched, found " +
                      std::to_string(num_marks));
  }
  Eigen::Vector3d device_mean_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d workspace_mean_m = Eigen::Vector3d::Zero();
  for (const TouchedMark& mark : marks) {
    device_mean_m += mark.device_m / num_marks;
    workspace_mean_m += mark.workspace_m / num_marks;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const TouchedMark& mark : marks) {
    covariance +=
        (mark.workspace_m - workspace_mean_m) * (mark.device_m - device_mean_m).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& extent = svd.singularValues();
  // The extents are squared lengths here.
  if (!(extent[1] > kLeastBreadthRatio * kLeastBreadthRatio * extent[0])) {
    throw core::Error(
        "frame: expected marks that do not lie on one line, found some that do; add one beside "
        "the line");
  }
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;

  FrameFit fit;
  fit.num_marks = num_marks;
  fit.marks = marks;
  fit.rotation = svd.matrixU() * mirror * svd.matrixV().transpose();
  fit.offset_m = workspace_mean_m - fit.rotation * device_mean_m;

  // d(workspace) = turn x (rotation * device) + d(offset).
  double squares_m2 = 0.0;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  for (const TouchedMark& mark : marks) {
    const Eigen::Vector3d turned_m = fit.rotation * mark.device_m;
    squares_m2 += (mark.workspace_m - turned_m - fit.offset_m).squaredNorm();
    Eigen::Matrix<double, 3, 6> change;
    change << -cross_matrix(turned_m), Eigen::Matrix3d::Identity();
    information += change.transpose() * change;
  }
  const double degrees_of_freedom = 3.0 * num_marks - 6.0;
  fit.residual_m = std::sqrt(squares_m2 / degrees_of_freedom);
  const Eigen::Matrix<double, 6, 1> half_width = student_t975(degrees_of_freedom) *
                                                 fit.residual_m *
                                                 information.inverse().diagonal().cwiseSqrt();
  fit.rotation_ci95_rad = half_width.head<3>();
  fit.offset_ci95_m = half_width.tail<3>();
  return fit;
}

Eigen::Vector3d missed_by_m(const FrameFit& fit, const TouchedMark& mark) {
  return fit.rotation * mark.device_m + fit.offset_m - mark.workspace_m;
}

}  // namespace jnd::analysis
