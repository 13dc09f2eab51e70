#pragma once

#include <string>
#include <vector>

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

/// The study with the intensities that these devices delivered, without those who answer the
/// wrong way round where that is asked for.
[[nodiscard]] analysis::DeliveredStudy delivered_study(const core::StudyStore& store,
                                                       const analysis::StudyData& as_commanded,
                                                       const analysis::DeviceParts& parts,
                                                       bool leaves_out_inverted);

/// Gives each estimate of `results`, which are of `delivered_study`, the interval that its
/// values at both ends of the damping span.
void tell_device_part(analysis::StudyResults& results, const core::StudyStore& store,
                      const analysis::StudyData& as_commanded, const MeasuredDevices& devices,
                      const analysis::ResultsOptions& options, bool leaves_out_inverted);
/// The same of results that are there already.
void tell_device_part(analysis::StudyResults& results, const analysis::StudyResults& at_least,
                      const analysis::StudyResults& at_most);

/// A sentence a device that sessions of this study were run on: which it is, when it was
/// measured, gain and own damping, how many sessions.
[[nodiscard]] std::vector<std::string> measured_device_words(const core::StudyStore& store,
                                                             const MeasuredDevices& devices);

/// These intervals, a line each; "" where there are none.
[[nodiscard]] std::string device_part_table(const analysis::StudyResults& results);

}  // namespace jnd::app
