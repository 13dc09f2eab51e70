#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "device/exoskeleton/stability_map.h"
#include "experiments/session/plan.h"

namespace jnd::app {

/// One case with what was measured in it.
struct StabilityRow {
  device::StabilityCase measured_case;
  device::ExoskeletonStability limits;
};

/// Up to which viscosity and stiffness a device is stable: `jnd stability` makes it.
struct StabilityMap {
  std::string device;  ///< Its name in the registry.
  std::vector<StabilityRow> rows;
  /// "on 2026-11-25 with a phantom of 0.2 kg", of a device profile; "": simulated, as shipped.
  std::string measured{};
};

[[nodiscard]] nlohmann::ordered_json to_json(const StabilityMap& map);
/// Throws `core::Error` naming the file and what is wrong in it.
[[nodiscard]] StabilityMap read_stability_map(const std::filesystem::path& file);
/// The map shipped for this device; none for a device that has none. Throws as
/// `read_stability_map`.
[[nodiscard]] std::optional<StabilityMap> shipped_stability_map(const std::string& device);

/// The stimuli of a study against the map, in its loop's own time: without extra delay.
struct StabilityCheck {
  /// Of the rows compared with: the highest rate measured that is not above the study's, or the
  /// lowest there is.
  double rate_hz = 0.0;
  device::ExoskeletonStability attached, detached;
  std::string measured{};            ///< As in the map.
  std::vector<bool> is_stable;       ///< Of each stimulus, with the hand attached.
  std::vector<bool> needs_the_hand;  ///< Stable with it, not with a finger that came off.

  [[nodiscard]] int num_unstable() const;
  [[nodiscard]] int num_needing_the_hand() const;
};

/// A fluid counts with the slope of its drag at the expected speed, head on, as the viscosity
/// that has it. None if the map has no rows without delay.
[[nodiscard]] std::optional<StabilityCheck> check_stability(
    const StabilityMap& map, const experiments::Study& study,
    const std::vector<experiments::RangeEntry>& range, double expected_speed_m_per_s);

/// "512 Pa s or more": a limit for people.
[[nodiscard]] std::string words_of(const device::StabilityLimit& limit, const char* unit);

/// "`exoskeleton` renders stably at 1000 Hz", ", as measured on 2026-11-25 with ..." where it
/// was.
[[nodiscard]] std::string stably_words(const StabilityCheck& check, const std::string& device);

/// "expected stimuli that `exoskeleton` renders stably at 1000 Hz (on the hand up to ...),
/// found 2 of 8 beyond": where some are unstable.
[[nodiscard]] std::string unstable_words(const StabilityCheck& check,
                                         const std::string& device);

/// What detached fingers would do, a sentence; "" where nothing of the study reaches that far.
[[nodiscard]] std::string detached_remark(const StabilityCheck& check);

}  // namespace jnd::app
