#pragma once

#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/movement/delivered_intensity.h"
#include "analysis/results/study_results.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// What the profiles stored with sessions say about gain and own damping: as measured, and with
/// the damping at either end of its interval, because the damping over the gain is what changes
/// a Weber fraction. Sessions without a profile are left out, and so are those whose profile
/// has neither measurement.
struct MeasuredDevices {
  analysis::DeviceParts parts, least, most;
};

/// Throws `core::Error` if the study lacks a profile that a session names.
[[nodiscard]] MeasuredDevices measured_devices(const core::StudyStore& store,
                                               const analysis::StudyData& data);

/// The study with the intensities that these devices delivered. If `leaves_out_inverted`, it
/// leaves out people who answer the wrong way round.
[[nodiscard]] analysis::DeliveredStudy delivered_study(const core::StudyStore& store,
                                                       const analysis::StudyData& as_commanded,
                                                       const analysis::DeviceParts& parts,
                                                       bool leaves_out_inverted);

/// Gives each estimate of `results`, which come from `delivered_study`, the interval between
/// its values at both ends of the damping.
void tell_device_part(analysis::StudyResults& results, const core::StudyStore& store,
                      const analysis::StudyData& as_commanded, const MeasuredDevices& devices,
                      const analysis::ResultsOptions& options, bool leaves_out_inverted);
/// Does the same with results that were already computed.
void tell_device_part(analysis::StudyResults& results, const analysis::StudyResults& at_least,
                      const analysis::StudyResults& at_most);

/// One sentence for each device on which sessions of this study were run: which device it is,
/// when it was measured, its gain and own damping, and how many sessions it had.
[[nodiscard]] std::vector<std::string> measured_device_words(const core::StudyStore& store,
                                                             const MeasuredDevices& devices);

/// These intervals, one line each; "" if there are none.
[[nodiscard]] std::string device_part_table(const analysis::StudyResults& results);

}  // namespace jnd::app
