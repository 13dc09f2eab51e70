#include "analysis/movement/delivered_intensity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/error.h"
#include "core/storage/recording.h"

namespace jnd::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Mean {
  double sum = 0.0;
  int count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  [[nodiscard]] std::optional<double> value() const {
    if (count == 0) return std::nullopt;
    return sum / count;
  }
};

/// What one presentation delivered.
struct Delivery {
  std::string interval;
  double commanded = 0.0, delivered = 0.0;
};

using Deliveries = std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Delivery>>;

/// Presentations come in their order. Of a trial's tests, only those with the intensity of the
/// last one count, because the others of a production led up to it.
DeliveredIntensities trials_of(const Deliveries& deliveries) {
  DeliveredIntensities trials;
  for (const auto& [key, presented] : deliveries) {
    Mean reference, test;
    double last_test = 0.0;
    for (const Delivery& one : presented) {
      if (one.interval == "reference") reference.add(one.delivered);
      if (one.interval != "test") continue;
      if (one.commanded != last_test) test = {};
      last_test = one.commanded;
      test.add(one.delivered);
    }
    trials[key] = {.test = test.value(), .reference = reference.value()};
  }
  return trials;
}

bool is_measured(double commanded, double delivered) {
  return commanded > 0.0 && std::isfinite(delivered) && delivered > 0.0;
}

/// Replaces the intensities of one participant's trials in one block.
class BlockReplacement {
 public:
  explicit BlockReplacement(const DeliveredIntensities& delivered) : delivered_(delivered) {}

  void measure(const core::TrialRow& trial) {
    const auto found = delivered_.find({trial.session, trial.trial});
    if (found == delivered_.end() || !trial.intensity) return;
    if (found->second.test) levels_[*trial.intensity].add(*found->second.test);
    if (found->second.reference) reference_.add(*found->second.reference);
  }

  /// Returns whether the trial's stimulus is known.
  bool replace(core::TrialRow& trial) const {
    if (!trial.intensity) return false;
    if (*trial.intensity == 0.0) return true;
    if (trial.target_percent) return replace_production(trial);
    if (trial.starting_intensity) return replace_matching(trial);
    const auto level = levels_.find(*trial.intensity);
    if (level == levels_.end()) return false;
    double intensity = *level->second.value();
    if (trial.reference_intensity) {
      const std::optional<double> reference = reference_.value();
      if (!reference || !(*reference > 0.0)) return false;
      intensity *= *trial.reference_intensity / *reference;
    }
    trial.intensity = intensity;
    return true;
  }

 private:
  bool replace_production(core::TrialRow& trial) const {
    const auto found = delivered_.find({trial.session, trial.trial});
    if (found == delivered_.end() || !found->second.test) return false;
    trial.intensity = found->second.test;
    trial.response = found->second.test;
    return true;
  }

  /// Uses the delivered intensity of the value that was set, divided by that of the standard if
  /// it is known. The force of many fluids was never measured.
  bool replace_matching(core::TrialRow& trial) const {
    if (!replace_production(trial)) return false;
    const std::optional<double> standard =
        delivered_.at({trial.session, trial.trial}).reference;
    if (!standard || !(*standard > 0.0) || !trial.reference_intensity) return true;
    trial.intensity = *trial.intensity * *trial.reference_intensity / *standard;
    trial.response = trial.intensity;
    return true;
  }

  const DeliveredIntensities& delivered_;
  std::map<double, Mean> levels_;  ///< Indexed by commanded intensity.
  Mean reference_;
};

}  // namespace

static DevicePart device_of(const DeviceParts& devices, std::int64_t session) {
  const auto found = devices.find(session);
  return found == devices.end() ? DevicePart() : found->second;
}

DeliveredIntensities delivered_intensities(const StudyData& data, const DeviceParts& devices) {
  Deliveries deliveries;
  for (const ParticipantData& participant : data.participants) {
    for (const auto& [block, rows] : participant.presentations) {
      for (const core::PresentationRow& row : rows) {
        const double commanded = row.measures.commanded_damping_n_s_per_m.value_or(0.0);
        const double delivered = row.measures.delivered_damping_n_s_per_m.value_or(0.0);
        if (!is_measured(commanded, delivered)) continue;
        const DevicePart device = device_of(devices, row.session);
        const double whole = device.gain * delivered + device.damping_n_s_per_m;
        deliveries[{row.session, row.trial}].push_back(
            {row.interval, row.intensity, row.intensity * whole / commanded});
      }
    }
  }
  return trials_of(deliveries);
}

DeliveredIntensities delivered_intensities(const MovementAnalysis& movement,
                                           const DeviceParts& devices) {
  Deliveries deliveries;
  for (const ParticipantMovement& participant : movement.participants) {
    for (const PresentationMovement& one : participant.presentations) {
      const double ratio = one.force.delivered_ratio.value_or(0.0);
      if (one.trial == 0 || !is_measured(1.0, ratio)) continue;
      // The device's own damping divided by that of the stimulus at the same speed.
      const DevicePart device = device_of(devices, one.session);
      const double own = device.damping_n_s_per_m * ratio /
                         one.force.delivered_damping_n_s_per_m.value_or(kInfinity);
      deliveries[{one.session, one.trial}].push_back(
          {one.interval, one.intensity, one.intensity * (device.gain * ratio + own)});
    }
  }
  return trials_of(deliveries);
}

DeliveredStudy with_delivered(StudyData data, const DeliveredIntensities& delivered) {
  DeliveredStudy study{.data = std::move(data)};
  study.data.delivered = true;
  for (ParticipantData& participant : study.data.participants) {
    std::map<std::string, BlockReplacement> blocks;
    for (const core::TrialRow& trial : participant.trials) {
      blocks.try_emplace(trial.block, delivered).first->second.measure(trial);
    }
    std::vector<core::TrialRow> kept;
    for (core::TrialRow& trial : participant.trials) {
      if (blocks.at(trial.block).replace(trial)) kept.push_back(std::move(trial));
    }
    study.num_left_out += static_cast<std::int64_t>(participant.trials.size() - kept.size());
    study.num_replaced += static_cast<std::int64_t>(kept.size());
    participant.trials = std::move(kept);
  }
  return study;
}

/// If the samples of a session were not kept, nobody can tell, and the force counts as sent.
static bool is_measured_by_recording(const core::StudyStore& store, std::int64_t session) {
  try {
    const core::RecordingReader reader(store.recording_file(session));
    return (reader.channels() & core::kMeasuredForce) != 0;
  } catch (const core::Error&) {
    return false;
  }
}

DeliveredStudy with_delivered(StudyData data, const core::StudyStore& store,
                              const DeviceParts& all_devices) {
  // The force that sensors measured includes the device's part.
  DeviceParts devices = all_devices;
  std::erase_if(
      devices, [&](const auto& entry) { return is_measured_by_recording(store, entry.first); });
  DeliveredIntensities delivered = delivered_intensities(data, devices);
  const bool enough = std::ranges::all_of(data.participants, [&](const ParticipantData& one) {
    return std::ranges::all_of(one.trials, [&](const core::TrialRow& trial) {
      return trial.intensity == 0.0 || delivered.contains({trial.session, trial.trial});
    });
  });
  if (!enough) {
    for (auto& [key, trial] :
         delivered_intensities(analyse_movement(store, {.explored = false}), devices)) {
      delivered.try_emplace(key, trial);
    }
  }
  const ForceSource source = force_source_of(data, store);
  DeliveredStudy study = with_delivered(std::move(data), delivered);
  study.force_source = source;
  return study;
}

ForceSource force_source_of(const StudyData& data, const core::StudyStore& store) {
  std::set<std::int64_t> sessions;
  for (const ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials) sessions.insert(trial.session);
  }
  std::size_t num_measured = 0;
  for (const std::int64_t session : sessions) {
    num_measured += is_measured_by_recording(store, session) ? 1 : 0;
  }
  if (num_measured == 0) return ForceSource::kSent;
  return num_measured == sessions.size() ? ForceSource::kMeasured : ForceSource::kBoth;
}

std::string_view name(ForceSource source) noexcept {
  switch (source) {
    case ForceSource::kSent:
      return "sent";
    case ForceSource::kMeasured:
      return "measured";
    case ForceSource::kBoth:
      return "both";
  }
  return "unknown";
}

}  // namespace jnd::analysis
