#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "device/exoskeleton/stability_map.h"
#include "experiments/session/plan.h"

namespace jnd::app {

/// A case and what was measured in it.
struct StabilityRow {
  device::StabilityCase measured_case;
  device::ExoskeletonStability limits;
};

/// Up to which viscosity and stiffness a device is stable; `jnd stability` makes it.
struct StabilityMap {
  std::string device;  ///< The device's name in the registry.
  std::vector<StabilityRow> rows;
  /// For a device profile, such as "on 2026-11-25 with a phantom of 0.2 kg"; "" for a shipped
  /// map, which is simulated.
  std::string measured{};
};

[[nodiscard]] nlohmann::ordered_json to_json(const StabilityMap& map);
/// Throws `core::Error`, which names the file and what is wrong in it.
[[nodiscard]] StabilityMap read_stability_map(const std::filesystem::path& file);
/// The map that is shipped for this device; none if there is none. Throws as
/// `read_stability_map` does.
[[nodiscard]] std::optional<StabilityMap> shipped_stability_map(const std::string& device);

/// The stimuli of a study compared with the map at the study's own rate, without extra delay.
struct StabilityCheck {
  /// The rate of the rows that were compared: the highest measured rate that is not above the
  /// study's, or else the lowest one.
  double rate_hz = 0.0;
  device::ExoskeletonStability attached, detached;
  std::string measured{};       ///< As in the map.
  std::vector<bool> is_stable;  ///< For each stimulus, with the hand attached.
  /// Stable with the hand, but not with a finger that came off.
  std::vector<bool> needs_the_hand;

  [[nodiscard]] int num_unstable() const;
  [[nodiscard]] int num_needing_the_hand() const;
};

/// A fluid counts as the viscosity whose drag has the same slope as the fluid's drag at the
/// expected speed, head on. None if the map has no rows without delay.
[[nodiscard]] std::optional<StabilityCheck> check_stability(
    const StabilityMap& map, const experiments::Study& study,
    const std::vector<experiments::RangeEntry>& range, double expected_speed_m_per_s);

/// A limit for people, such as "512 Pa s or more".
[[nodiscard]] std::string words_of(const device::StabilityLimit& limit, const char* unit);

/// Such as "`exoskeleton` renders stably at 1000 Hz"; if it was measured, followed by ", as
/// measured on 2026-11-25 with ...".
[[nodiscard]] std::string stably_words(const StabilityCheck& check, const std::string& device);

/// If some stimuli are unstable: "expected stimuli that `exoskeleton` renders stably at 1000 Hz
/// (on the hand up to ...), found 2 of 8 beyond".
[[nodiscard]] std::string unstable_words(const StabilityCheck& check,
                                         const std::string& device);

/// What fingers that came off would do, in a sentence; "" if nothing in the study is that
/// strong.
[[nodiscard]] std::string detached_remark(const StabilityCheck& check);

}  // namespace jnd::app
