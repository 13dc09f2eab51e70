#pragma once

#include <Eigen/Core>
#include <vector>

namespace jnd::analysis {

/// A mark that was touched: where the device says it is, and where it is.
struct TouchedMark {
  Eigen::Vector3d device_m = Eigen::Vector3d::Zero();     ///< In the device's own frame.
  Eigen::Vector3d workspace_m = Eigen::Vector3d::Zero();  ///< In the workspace frame.
};

/// Where the device's own frame lies: workspace = rotation * device + offset.
struct FrameFit {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  /// Half widths of 95 % intervals: of a turn about each axis of the workspace, and of the
  /// offset along each.
  Eigen::Vector3d rotation_ci95_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset_ci95_m = Eigen::Vector3d::Zero();
  double residual_m = 0.0;  ///< Standard deviation on each axis of how marks were met.
  int num_marks = 0;
  std::vector<TouchedMark> marks;  ///< That it rests on.
};

/// The rotation and the offset with the least squared distances (Kabsch 1976; Arun, Huang and
/// Blostein 1987), intervals by linearising about them. Throws `core::Error` for fewer than
/// four marks, and where they lie on a line or nearly so: then a turn about it stays open.
[[nodiscard]] FrameFit fit_frame(const std::vector<TouchedMark>& marks);

/// Where the device says that a mark is, in the workspace, less where it is [m].
[[nodiscard]] Eigen::Vector3d missed_by_m(const FrameFit& fit, const TouchedMark& mark);

}  // namespace jnd::analysis
