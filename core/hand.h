#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

namespace jnd::core {

/// The five places where a finger of the exoskeleton meets the participant's hand. They are in
/// the order of the exoskeleton's fingers (thesis, fig. D.18): two at the palm, then thumb,
/// index and middle.
enum class ContactPoint { kPalmInner, kPalmOuter, kThumb, kIndex, kMiddle };

inline constexpr int kNumContactPoints = 5;

inline constexpr std::array<std::string_view, kNumContactPoints> kContactPointNames = {
    "palm_inner", "palm_outer", "thumb", "index", "middle"};

/// The share of the hand's force that each point carries: above 0 at the points that a device
/// has, 0 elsewhere, 1 in total. So a study renders the same total force with any number of
/// points.
using ShareRatios = std::array<double, kNumContactPoints>;

/// The shares of a device that has all five points and declares no others. They follow the
/// areas of the parts of the hand, 64/10/12/14 %, as rounded by the thesis (sec. B.5).
inline constexpr ShareRatios kAreaShareRatio = {0.35, 0.35, 0.10, 0.10, 0.10};

/// Returns the shares of a device that has these points (bit i: point i) and declares no
/// others: their areas relative to one another. All zero without any point. Real time.
[[nodiscard]] constexpr ShareRatios area_shares(unsigned point_bits) noexcept {
  constexpr unsigned kAllPoints = (1U << kNumContactPoints) - 1;
  if ((point_bits & kAllPoints) == kAllPoints) return kAreaShareRatio;
  ShareRatios shares{};
  double sum = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if ((point_bits >> i & 1U) != 0) sum += shares[i] = kAreaShareRatio[i];
  }
  for (double& share : shares) share = sum > 0.0 ? share / sum : 0.0;
  return shares;
}

/// Scales the shares so that they add up to 1 and keep their ratios. None may be below 0, and
/// not all 0. Real time.
[[nodiscard]] constexpr ShareRatios normalised_shares(ShareRatios shares) noexcept {
  double sum = 0.0;
  for (const double share : shares) sum += share;
  // Shares whose sum differs from 1 only by rounding stay as they are, to the last bit.
  constexpr double kRounding = 1e-12;
  if (sum - 1.0 <= kRounding && 1.0 - sum <= kRounding) return shares;
  for (double& share : shares) share /= sum;
  return shares;
}

/// Returns the shares of a device that has the first `num_points` points.
[[nodiscard]] constexpr ShareRatios area_shares_of_first(int num_points) noexcept {
  return area_shares((1U << static_cast<unsigned>(num_points)) - 1);
}

/// One vector for each contact point, in the order of `ContactPoint`.
using PointVectors = std::array<Eigen::Vector3d, kNumContactPoints>;

[[nodiscard]] inline PointVectors zero_vectors() noexcept {
  PointVectors vectors;
  for (Eigen::Vector3d& vector : vectors) vector.setZero();
  return vectors;
}

/// How the hand as a whole moves through the medium, as the drag laws need it.
struct HandMotion {
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();  ///< Mean velocity of the tips.
  double speed_m_per_s = 0.0;
  /// Sine of the angle of attack: 0 edge on, 1 head on. 0 for a hand at rest.
  double sin_angle_of_attack = 0.0;
};

inline constexpr std::array<bool, kNumContactPoints> kAllAttached = {true, true, true, true,
                                                                     true};

/// Returns the tip that spans the hand plane together with the two points of the palm: the
/// index (thesis, C.3.1), or the middle finger if the index came off. Returns none unless both
/// points of the palm and one of these fingers are attached, because a dangling link must not
/// steer the force on the other points. Real time.
[[nodiscard]] std::optional<ContactPoint> tip_of_hand_plane(
    const std::array<bool, kNumContactPoints>& attached) noexcept;

/// Returns the unit normal of the hand plane, which goes through both palm points and
/// `tip_of_hand_plane`. Zero if there is no such tip or the three points lie on a line. Its
/// sign has no meaning. Real time.
[[nodiscard]] Eigen::Vector3d hand_plane_normal(
    const PointVectors& tip_position_m,
    const std::array<bool, kNumContactPoints>& attached = kAllAttached) noexcept;

/// Computes the hand's motion from its tips, in any one frame. Tips that came off are ignored,
/// however they dangle. If none is left, the hand counts as at rest. Without a hand plane it
/// counts as edge on, which gives the least drag. Real time.
[[nodiscard]] HandMotion hand_motion(
    const PointVectors& tip_position_m, const PointVectors& tip_velocity_m_per_s,
    const std::array<bool, kNumContactPoints>& attached = kAllAttached) noexcept;

}  // namespace jnd::core
