#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/hand.h"
#include "core/media/medium.h"
#include "core/sample.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// The force over the ticks of a presentation after the ramp.
struct DeliveredForce {
  std::optional<double> delivered_n;  ///< The mean delivered force against the motion.
  /// The mean of the law at the hand's speed, without limits.
  std::optional<double> commanded_n;
  /// The mean force divided by the mean speed.
  std::optional<double> delivered_damping_n_s_per_m;
  /// Delivered force divided by commanded force.
  std::optional<double> delivered_ratio;
  /// Whether force sensors measured it. Otherwise it is the force that was sent.
  bool is_measured = false;
};

/// Rendered force by speed, in classes of 2 cm/s with at least 20 ticks each.
struct ForceBySpeed {
  std::vector<double> speed_m_per_s;  ///< The mean over the ticks of each class.
  std::vector<double> delivered_n;    ///< The mean force against the motion, after every limit.
  /// The mean force of the law at these speeds; empty if the law is unknown.
  std::vector<double> commanded_n;
  bool is_measured = false;  ///< Whether force sensors measured it.
};

/// The force of a stimulus, as far as the database describes it: only drag, fully immersed,
/// without ramp and limits. It is unknown for solids, lift, buoyancy and force maps.
class CommandedForce {
 public:
  CommandedForce() = default;
  /// `damping_n_s_per_m` comes from the presentation's row. If it is present, the name of the
  /// medium does not matter.
  CommandedForce(const std::string& medium, double intensity,
                 std::optional<double> damping_n_s_per_m);

  [[nodiscard]] bool is_known() const noexcept { return amounts_.has_value(); }
  /// The force against the motion. `speed_m_per_s` is that of the hand in the sample. It is 0
  /// if the law is unknown.
  [[nodiscard]] double opposing_n(const core::Sample& sample, double speed_m_per_s) const;

 private:
  std::optional<core::MediumAmounts> amounts_;
  bool is_plain_damping_ = false;
};

/// Adds up delivered and commanded force, overall and by classes of speed. If the commanded
/// force is unknown for some ticks, it is unknown for all.
class ForceSums {
 public:
  void add(double speed_m_per_s, double delivered_n, double commanded_n) noexcept;
  void add(const ForceSums& other) noexcept;
  void is_measured() noexcept { is_measured_ = true; }
  void commanded_is_unknown() noexcept { commanded_known_ = false; }
  [[nodiscard]] DeliveredForce delivered() const noexcept;
  [[nodiscard]] ForceBySpeed by_speed() const;

 private:
  struct Sums {
    double num_ticks = 0.0, speed_m_per_s = 0.0, delivered_n = 0.0, commanded_n = 0.0;
    void add(const Sums& other) noexcept;
  };

  bool commanded_known_ = true;
  bool is_measured_ = false;
  Sums all_;
  std::vector<Sums> classes_;
};

}  // namespace jnd::analysis
