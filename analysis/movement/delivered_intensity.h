#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/data/study_data.h"
#include "analysis/movement/movement_analysis.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// The intensities that a trial's stimuli really had, in the unit of their intensities:
/// commanded intensity times delivered force divided by commanded force, because every law is
/// linear in its intensity. They are means over presentations. For a production it is the last
/// presentation, which has the value that was set. They are absent if nothing was measured or
/// no force was commanded.
struct DeliveredTrial {
  std::optional<double> test, reference;
};

/// The delivered intensities by session and number of the trial.
using DeliveredIntensities = std::map<std::pair<std::int64_t, std::int64_t>, DeliveredTrial>;

/// What a device makes of the force that it is sent, as it was measured: gain * force + damping
/// * speed opposes the hand. If sensors measured the force, nothing needs to be added.
struct DevicePart {
  double gain = 1.0;
  double damping_n_s_per_m = 0.0;
};
/// The parts by session. Sessions on devices that were not measured are missing.
using DeviceParts = std::map<std::int64_t, DevicePart>;

/// Uses only the database, so it covers fluids that are plain damping.
[[nodiscard]] DeliveredIntensities delivered_intensities(const StudyData& data,
                                                         const DeviceParts& devices = {});
/// Uses the samples, so it covers every fluid whose law is known, including water.
[[nodiscard]] DeliveredIntensities delivered_intensities(const MovementAnalysis& movement,
                                                         const DeviceParts& devices = {});

/// What counts as delivered force: the force that was sent to the device after every limit, or
/// the force that sensors measured. `kBoth` means that sessions differ.
enum class ForceSource { kSent, kMeasured, kBoth };

/// The source of the forces in the recordings of these sessions.
[[nodiscard]] ForceSource force_source_of(const StudyData& data, const core::StudyStore& store);
/// "sent", "measured" or "both".
[[nodiscard]] std::string_view name(ForceSource source) noexcept;

/// A study with delivered instead of commanded intensities.
struct DeliveredStudy {
  StudyData data;
  std::int64_t num_replaced = 0;  ///< The number of trials whose intensity was replaced.
  /// The number of trials left out because their stimulus was not measured.
  std::int64_t num_left_out = 0;
  ForceSource force_source = ForceSource::kSent;
};

/// Prepares fits on delivered intensity. One presentation alone is a noisy measure, so a trial
/// gets the mean of what its participant received at its level. If there is a reference, it
/// keeps its value, and the test gets its delivered ratio to the reference, on which a Weber
/// fraction rests. A production gets the delivered intensity of the value that was set. So does
/// a matching, with the standard as its reference. An intensity of zero stays zero.
[[nodiscard]] DeliveredStudy with_delivered(StudyData data,
                                            const DeliveredIntensities& delivered);

/// Does the same, and reads the recordings only if the database is not sufficient.
[[nodiscard]] DeliveredStudy with_delivered(StudyData data, const core::StudyStore& store,
                                            const DeviceParts& devices = {});

}  // namespace jnd::analysis
