#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/movement/movement_analysis.h"
#include "analysis/movement/presentation_meter.h"
#include "analysis/movement/session_presentations.h"
#include "core/storage/recording.h"

namespace jnd::analysis {

/// Reads the recordings of one participant and adds up the movement. Not real time.
class ParticipantReading {
 public:
  /// The store must outlive the object.
  ParticipantReading(const core::StudyStore& store, MovementOptions options,
                     std::string participant);

  /// Throws `core::Error` for a damaged recording.
  void read_session(const core::SessionRow& session);
  /// Returns the result. The object must not be used afterwards.
  [[nodiscard]] ParticipantMovement finish();

 private:
  /// Explored media come last. The whole block comes before its levels.
  using ConditionKey = std::tuple<bool, std::string, std::string, std::optional<double>>;
  struct Condition {
    int num_presentations = 0, num_marked = 0;
    MovementSums sums;
  };
  struct Trial {
    TrialMovement movement;
    MovementSums sums;
  };

  void read_samples(const core::RecordingReader& reader, double ramp_s,
                    const std::vector<PlannedPresentation>& planned);
  void take(const PlannedPresentation& planned, PresentationMeter::Result result);
  void add_to(const ConditionKey& key, const PresentationMeter::Result& result);

  const core::StudyStore& store_;
  MovementOptions options_;
  ParticipantMovement found_;
  bool any_recording_ = false;
  std::map<ConditionKey, Condition> conditions_;
  std::map<std::pair<std::int64_t, std::int64_t>, Trial> trials_;
};

}  // namespace jnd::analysis
