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

/// What was delivered over the ticks of a presentation, after the ramp.
struct DeliveredForce {
  std::optional<double> delivered_n;  ///< Mean delivered force against the motion.
  std::optional<double> commanded_n;  ///< Mean of the law at the hand's speed, without limits.
  std::optional<double> delivered_damping_n_s_per_m;  ///< Mean force over mean speed.
  std::optional<double> delivered_ratio;              ///< Delivered over commanded.
  bool is_measured = false;  ///< By sensors of force; else it is what was sent.
};

/// Rendered force against speed, in classes of speed of 2 cm/s that hold at least 20 ticks.
struct ForceBySpeed {
  std::vector<double> speed_m_per_s;  ///< Mean of the ticks of each class.
  std::vector<double> delivered_n;    ///< Mean against the motion, after every limit.
  std::vector<double> commanded_n;  ///< By the law at these speeds; empty where it is unknown.
  bool is_measured = false;         ///< By sensors of force.
};

/// The force that a stimulus stands for, from what the database knows of it: drag alone, fully
/// immersed, without ramp and limits. Unknown for solids, lift, buoyancy and force maps.
class CommandedForce {
 public:
  CommandedForce() = default;
  /// `damping_n_s_per_m`: as a presentation's row says, whatever the medium is called.
  CommandedForce(const std::string& medium, double intensity,
                 std::optional<double> damping_n_s_per_m);

  [[nodiscard]] bool is_known() const noexcept { return amounts_.has_value(); }
  /// Against the motion; `speed_m_per_s` of the hand that the sample is of. 0 if unknown.
  [[nodiscard]] double opposing_n(const core::Sample& sample, double speed_m_per_s) const;

 private:
  std::optional<core::MediumAmounts> amounts_;
  bool is_plain_damping_ = false;
};

/// Adds up delivered and commanded force, overall and by classes of speed. A commanded force
/// that is unknown for some ticks is unknown for all.
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
