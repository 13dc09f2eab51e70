#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

namespace jnd::core {

/// The five places where a finger of the exoskeleton meets the participant's hand. The order is
/// that of the exoskeleton's fingers (thesis, fig. D.18): two at the palm, then thumb, index,
/// middle.
enum class ContactPoint { kPalmInner, kPalmOuter, kThumb, kIndex, kMiddle };

inline constexpr int kNumContactPoints = 5;

inline constexpr std::array<std::string_view, kNumContactPoints> kContactPointNames = {
    "palm_inner", "palm_outer", "thumb", "index", "middle"};

/// Share of the fluid's force that each point carries; they sum to 1. From the areas of the
/// parts of the hand, 64/10/12/14 %, rounded by the thesis (sec. B.5).
inline constexpr std::array<double, kNumContactPoints> kAreaShareRatio = {0.35, 0.35, 0.10,
                                                                          0.10, 0.10};

/// What the first `num_points` points, in [1, 5], carry together: those that a device declares.
/// A force meant for the whole hand is divided by it, so that 1, 2, 3 and 5 points come to the
/// same. Exactly 1 for all five. Real time.
[[nodiscard]] constexpr double declared_share_ratio(int num_points) noexcept {
  if (num_points >= kNumContactPoints) return 1.0;
  double sum = kAreaShareRatio[0];
  for (int i = 1; i < num_points; ++i) sum += kAreaShareRatio[static_cast<std::size_t>(i)];
  return sum;
}

/// One vector per contact point, in the order of `ContactPoint`.
using PointVectors = std::array<Eigen::Vector3d, kNumContactPoints>;

[[nodiscard]] inline PointVectors zero_vectors() noexcept {
  PointVectors vectors;
  for (Eigen::Vector3d& vector : vectors) vector.setZero();
  return vectors;
}

/// How the hand as a whole moves through the medium: what a drag law needs to know.
struct HandMotion {
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();  ///< Mean of the tips.
  double speed_m_per_s = 0.0;
  /// Sine of the angle of attack: 0 edge on, 1 head on. 0 for a hand at rest.
  double sin_angle_of_attack = 0.0;
};

inline constexpr std::array<bool, kNumContactPoints> kAllAttached = {true, true, true, true,
                                                                     true};

/// The tip that spans the hand plane with the palm's two points: the index (thesis, C.3.1), the
/// middle finger where the index came off; nothing without both points of the palm or without
/// either finger, for a dangling link must not steer the force on the others. Real time.
[[nodiscard]] std::optional<ContactPoint> tip_of_hand_plane(
    const std::array<bool, kNumContactPoints>& attached) noexcept;

/// Unit normal of the hand plane, through both palm points and `tip_of_hand_plane`. Zero if
/// there is none or the three points lie on a line. Its sign has no meaning. Real time.
[[nodiscard]] Eigen::Vector3d hand_plane_normal(
    const PointVectors& tip_position_m,
    const std::array<bool, kNumContactPoints>& attached = kAllAttached) noexcept;

/// Motion of the hand from its tips; any one frame. A tip that came off has no say in it,
/// however it dangles; with none left the hand counts as at rest, without a hand plane as edge
/// on, which is the least drag. Real time.
[[nodiscard]] HandMotion hand_motion(
    const PointVectors& tip_position_m, const PointVectors& tip_velocity_m_per_s,
    const std::array<bool, kNumContactPoints>& attached = kAllAttached) noexcept;

}  // namespace jnd::core
