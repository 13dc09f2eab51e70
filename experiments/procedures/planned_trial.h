#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "core/stored_column.h"

namespace jnd::experiments {

/// One trial as it was drawn. Which fields are set depends on the procedure.
struct PlannedTrial {
  int repetition = 1;                         ///< Counted from 1.
  int position = 1;                           ///< Position within the repetition, from 1.
  std::optional<double> intensity;            ///< Test stimulus, in the unit of the quantity.
  std::optional<double> reference_intensity;  ///< In the unit of the quantity.
  std::optional<double> starting_intensity;   ///< For production and matching.
  std::optional<double> target_percent;       ///< For production.
  std::optional<int> series;                  ///< Staircase or series of the trial, from 1.
  std::optional<int> test_interval;           ///< 1 or 2, if the order is drawn.
  bool is_catch = false;                      ///< A catch trial: there is nothing to find.
  /// What each of three intervals holds, as in "rtr": 'r' the reference, 't' the test.
  /// Otherwise "".
  std::string intervals{};
  std::optional<int> right_interval{};  ///< The right one of three intervals, from 1.
};

}  // namespace jnd::experiments

namespace jnd::core {

/// The keys of a drawn trial in events. `DesignRow` and `TrialRow` have columns with these
/// names, which are copied by name.
template <>
inline constexpr auto kColumns<experiments::PlannedTrial> = [] {
  using experiments::PlannedTrial;
  using enum EventKey;
  return std::tuple{
      StoredColumn{&PlannedTrial::repetition, "repetition", "", "", kAlways},
      StoredColumn{&PlannedTrial::position, "position", "", "", kAlways},
      StoredColumn{&PlannedTrial::intensity, "intensity", "", "", kAlways},
      StoredColumn{&PlannedTrial::reference_intensity, "reference_intensity", "", "", kAlways},
      StoredColumn{&PlannedTrial::starting_intensity, "starting_intensity", "", "", kAlways},
      StoredColumn{&PlannedTrial::target_percent, "target_percent", "", "", kAlways},
      StoredColumn{&PlannedTrial::series, "series"},
      StoredColumn{&PlannedTrial::test_interval, "test_interval"},
      StoredColumn{&PlannedTrial::is_catch, "is_catch"},
      StoredColumn{&PlannedTrial::intervals, "intervals"},
      StoredColumn{&PlannedTrial::right_interval, "right_interval"}};
}();

}  // namespace jnd::core
