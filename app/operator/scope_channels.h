#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

/// A number of every sample that a scope can show.
struct ScopeChannel {
  /// The name as in `core::sample_column_names`, such as "index_force_x_n".
  std::string name;
  std::string label;  ///< Such as "index force x".
  std::string unit;   ///< Such as "N"; "" for bits and counts.

  friend bool operator==(const ScopeChannel&, const ScopeChannel&) = default;
};

/// Every column of a sample except its tick, in their order.
[[nodiscard]] std::vector<ScopeChannel> scope_channels(bool with_joints);

/// The channels whose label or unit contains every word that was typed, in capital or small
/// letters. All channels if nothing was typed.
[[nodiscard]] std::vector<ScopeChannel> channels_matching(
    const std::vector<ScopeChannel>& channels, std::string_view typed);

}  // namespace jnd::app
