#pragma once

#include <Eigen/Core>
#include <vector>

namespace jnd::analysis {

/// A touched mark: where the device says it is, and where it really is.
struct TouchedMark {
  Eigen::Vector3d device_m = Eigen::Vector3d::Zero();     ///< In the device's own frame.
  Eigen::Vector3d workspace_m = Eigen::Vector3d::Zero();  ///< In the workspace frame.
};

/// The place of the device's own frame: workspace = rotation * device + offset.
struct FrameFit {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  /// Half widths of 95 % intervals: of a rotation about each axis of the workspace, and of the
  /// offset along each axis.
  Eigen::Vector3d rotation_ci95_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset_ci95_m = Eigen::Vector3d::Zero();
  /// The standard deviation, on each axis, of the distances between marks and where the fit
  /// puts them.
  double residual_m = 0.0;
  int num_marks = 0;
  std::vector<TouchedMark> marks;  ///< The marks on which the fit rests.
};

/// Finds the rotation and offset with the least squared distances (Kabsch 1976; Arun, Huang and
/// Blostein 1987). The intervals come from linearising about them. Throws `core::Error` for
/// fewer than four marks, and if they lie nearly on a line, because the rotation about the line
/// is then undetermined.
[[nodiscard]] FrameFit fit_frame(const std::vector<TouchedMark>& marks);

/// Where the device says that a mark is, in the workspace, minus where it really is [m].
[[nodiscard]] Eigen::Vector3d missed_by_m(const FrameFit& fit, const TouchedMark& mark);

}  // namespace jnd::analysis
