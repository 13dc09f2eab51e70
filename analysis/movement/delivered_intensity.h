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

/// What a trial's stimuli came out as, in the unit of their intensities: commanded intensity
/// times delivered over commanded force, for every law is linear in its intensity. Mean over
/// presentations; of a production the last one, which is the value set. Absent where nothing
/// was measured or no force was commanded.
struct DeliveredTrial {
  std::optional<double> test, reference;
};

/// By session and number of the trial.
using DeliveredIntensities = std::map<std::pair<std::int64_t, std::int64_t>, DeliveredTrial>;

/// What a device makes of the force that it is sent, as it was measured: the hand is opposed by
/// gain * force + damping * speed. Where sensors measured the force there is nothing to add.
struct DevicePart {
  double gain = 1.0;
  double damping_n_s_per_m = 0.0;
};
/// By session; sessions on devices of which nothing was measured are not in it.
using DeviceParts = std::map<std::int64_t, DevicePart>;

/// From the database alone: of fluids that are plain damping.
[[nodiscard]] DeliveredIntensities delivered_intensities(const StudyData& data,
                                                         const DeviceParts& devices = {});
/// From the samples: of every fluid whose law is known, water among them.
[[nodiscard]] DeliveredIntensities delivered_intensities(const MovementAnalysis& movement,
                                                         const DeviceParts& devices = {});

/// What counts as delivered: the force as it was sent to the device, after every limit, or what
/// its sensors of force measured; `kBoth`: sessions differ.
enum class ForceSource { kSent, kMeasured, kBoth };

/// By what the recordings of these sessions hold.
[[nodiscard]] ForceSource force_source_of(const StudyData& data, const core::StudyStore& store);
/// "sent", "measured", "both".
[[nodiscard]] std::string_view name(ForceSource source) noexcept;

/// A study whose intensities are those that were delivered.
struct DeliveredStudy {
  StudyData data;
  std::int64_t num_replaced = 0;  ///< Trials.
  std::int64_t num_left_out = 0;  ///< Trials whose stimulus nobody measured.
  ForceSource force_source = ForceSource::kSent;
};

/// For fits on delivered intensity. A trial gets the mean of what its participant was delivered
/// at its level, since one presentation alone is a noisy measure. Where there is a reference,
/// that keeps its value and the test gets the delivered ratio to it: what a Weber fraction
/// rests on. A production gets what was delivered of the value set, a
/// matching too, with the standard as a reference. Zero intensity stays zero.
[[nodiscard]] DeliveredStudy with_delivered(StudyData data,
                                            const DeliveredIntensities& delivered);

/// The same, with the recordings read only if the database does not say enough.
[[nodiscard]] DeliveredStudy with_delivered(StudyData data, const core::StudyStore& store,
                                            const DeviceParts& devices = {});

}  // namespace jnd::analysis
