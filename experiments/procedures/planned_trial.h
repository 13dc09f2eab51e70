#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "core/stored_column.h"

namespace jnd::experiments {

/// One trial as it was drawn. Which fields are set depends on the procedure.
struct PlannedTrial {
  int repetition = 1;                         ///< From 1.
  int position = 1;                           ///< Within the repetition, from 1.
  std::optional<double> intensity;            ///< Of the test stimulus, unit of the quantity.
  std::optional<double> reference_intensity;  ///< Unit of the quantity.
  std::optional<double> starting_intensity;   ///< Production.
  std::optional<double> target_percent;       ///< Production.
  std::optional<int> series;                  ///< Staircase or series it is of, from 1.
  std::optional<int> test_interval;           ///< 1 or 2, where the order is drawn.
  bool is_catch = false;                      ///< Nothing is there to be found.
  /// Of three intervals what each holds, as in "rtr": 'r' the reference, 't' the test. Else "".
  std::string intervals{};
  std::optional<int> right_interval{};  ///< Of three intervals the right answer, from 1.
};

}  // namespace jnd::experiments

namespace jnd::core {

/// The keys of a drawn trial in events. `DesignRow` and `TrialRow` have columns of these names,
/// which are copied by name.
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
