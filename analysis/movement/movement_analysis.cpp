#include "analysis/movement/movement_analysis.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include "analysis/movement/participant_movement.h"
#include "core/parallel.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using SessionsOfPerson = std::vector<core::SessionRow>;

void require_valid(const MovementOptions& options) {
  core::require_positive(options.hysteresis_m, "hysteresis_m");
  core::require_positive(options.rest_speed_m_per_s, "rest_speed_m_per_s");
  core::require_positive(options.shortest_pause_s, "shortest_pause_s");
  if (options.forward) {
    const double length = std::hypot((*options.forward)[0], (*options.forward)[1]);
    core::require(length > 0.0 && std::isfinite(length), "forward",
                  "a finite direction that is not zero", length);
  }
  if (options.surface_height_m) {
    core::require(std::isfinite(*options.surface_height_m), "surface_height_m",
                  "a finite number", *options.surface_height_m);
  }
  core::require(options.jobs >= 1, "jobs", "a number >= 1", options.jobs);
}

ParticipantMovement movement_of(const core::StudyStore& store, const MovementOptions& options,
                                const std::string& participant,
                                const SessionsOfPerson& sessions) {
  // A damaged recording must not affect the results of the others.
  try {
    ParticipantReading reading(store, options, participant);
    for (const core::SessionRow& session : sessions) reading.read_session(session);
    return reading.finish();
  } catch (const core::Error& error) {
    return {.participant = participant, .reason = error.what()};
  }
}

}  // namespace

const ConditionMovement* ParticipantMovement::find(const std::string& block,
                                                   std::optional<double> intensity) const {
  for (const ConditionMovement& condition : conditions) {
    if (condition.block == block && condition.intensity == intensity) return &condition;
  }
  return nullptr;
}

bool MovementAnalysis::any() const noexcept {
  return std::ranges::any_of(
      participants, [](const ParticipantMovement& one) { return one.num_samples > 0; });
}

MovementAnalysis analyse_movement(const core::StudyStore& store,
                                  const MovementOptions& options) {
  require_valid(options);
  MovementAnalysis analysis;
  std::map<std::string, SessionsOfPerson> by_person;
  for (core::SessionRow& session : store.sessions()) {
    if (session.pilot && !options.pilot) continue;
    analysis.simulated = analysis.simulated || session.simulated;
    by_person[session.participant].push_back(std::move(session));
  }
  const std::vector<std::pair<std::string, SessionsOfPerson>> people(by_person.begin(),
                                                                     by_person.end());
  analysis.participants.resize(people.size());
  std::atomic<std::size_t> num_done = 0;
  core::for_each_index(people.size(), options.jobs, [&](std::size_t i) {
    const auto& [participant, sessions] = people[i];
    analysis.participants[i] = movement_of(store, options, participant, sessions);
    if (!options.on_progress) return;
    options.on_progress(static_cast<double>(++num_done) / static_cast<double>(people.size()));
  });
  return analysis;
}

}  // namespace jnd::analysis
