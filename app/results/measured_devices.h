#pragma once

#include <string>

#include "analysis/data/study_data.h"
#include "analysis/movement/delivered_intensity.h"
#include "analysis/results/study_results.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// What the profiles that sessions keep say of gain and own damping: as measured, and with the
/// damping at either end of its interval, for it is the damping over the gain that moves a
/// Weber fraction. Sessions without a profile, or one in which neither was measured, are in
/// none.
struct MeasuredDevices {
  analysis::DeviceParts parts, least, most;
};

/// Throws `core::Error` where the study lacks a profile that a session names.
[[nodiscard]] MeasuredDevices measured_devices(const core::StudyStore& store,
                                               const analysis::StudyData& data);

/// Gives each estimate of `results` the interval that its values at both ends span.
void tell_device_part(analysis::StudyResults& results, const analysis::StudyResults& at_least,
                      const analysis::StudyResults& at_most);

/// These intervals, a line each; "" where there are none.
[[nodiscard]] std::string device_part_table(const analysis::StudyResults& results);

}  // namespace jnd::app
