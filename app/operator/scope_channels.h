#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

/// A number of every sample that a scope can show.
struct ScopeChannel {
  std::string name;   ///< As `core::sample_column_names` spells it: "index_force_x_n".
  std::string label;  ///< "index force x"
  std::string unit;   ///< "N"; "" for bits and counts.

  friend bool operator==(const ScopeChannel&, const ScopeChannel&) = default;
};

/// Every column of a sample but its tick, in their order.
[[nodiscard]] std::vector<ScopeChannel> scope_channels(bool with_joints);

/// Those that hold every word of what was typed, in label or unit, whatever the case; all for
/// nothing.
[[nodiscard]] std::vector<ScopeChannel> channels_matching(
    const std::vector<ScopeChannel>& channels, std::string_view typed);

}  // namespace jnd::app
