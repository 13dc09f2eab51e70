#include "analysis/movement/participant_movement.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

namespace jnd::analysis {
namespace {

std::array<double, 2> unit(const std::array<double, 2>& vector) {
  const double length = std::hypot(vector[0], vector[1]);
  return {vector[0] / length, vector[1] / length};
}

/// The direction along x toward the end effector, or +x if that is less than 5 cm aside.
std::array<double, 2> forward_of(const core::Sample& sample) {
  constexpr double kAsideM = 0.05;
  const double x_m = hand_tick(sample, {1.0, 0.0}).x_m;
  return {sample.end_effector_position_m[0] < x_m - kAsideM ? -1.0 : 1.0, 0.0};
}

/// Distributes the samples of a session to its presentations, which do not overlap.
class PresentationCursor {
 public:
  using Taker = std::function<void(const PlannedPresentation&, PresentationMeter::Result)>;

  PresentationCursor(const std::vector<PlannedPresentation>& planned,
                     const PresentationMeter::Parameters& parameters, bool finds_forward,
                     TrajectoryTaker& trajectories, Taker taker)
      : planned_(planned),
        parameters_(parameters),
        finds_forward_(finds_forward),
        trajectories_(trajectories),
        taker_(std::move(taker)) {}

  void feed(const core::Sample& sample) {
    while (next_ < planned_.size() && sample.tick > planned_[next_].movement.last_tick) close();
    if (next_ == planned_.size() || sample.tick < planned_[next_].movement.first_tick) return;
    if (!open_) open(&sample);
    if (!meter_->feed(sample)) return;
    ++num_samples_;
    if (draws_) trajectories_.feed(meter_->hand(), sample);
  }

  /// Returns the number of samples that were used.
  std::int64_t finish() {
    while (next_ < planned_.size()) close();
    return num_samples_;
  }

 private:
  void open(const core::Sample* sample) {
    if (!meter_) {
      if (finds_forward_ && sample != nullptr) parameters_.forward = forward_of(*sample);
      meter_.emplace(parameters_);
    }
    const PlannedPresentation& now = planned_[next_];
    meter_->begin(now.movement, now.commanded);
    draws_ = !now.movement.block.empty() && now.movement.interval != "free_space";
    if (draws_) trajectories_.begin(now.movement);
    open_ = true;
  }

  /// A presentation without any sample is missing entirely.
  void close() {
    if (!open_) open(nullptr);
    taker_(planned_[next_], meter_->finish());
    open_ = false;
    ++next_;
  }

  const std::vector<PlannedPresentation>& planned_;
  PresentationMeter::Parameters parameters_;
  bool finds_forward_;
  TrajectoryTaker& trajectories_;
  Taker taker_;
  std::optional<PresentationMeter> meter_;
  std::size_t next_ = 0;
  bool open_ = false, draws_ = false;
  std::int64_t num_samples_ = 0;
};

}  // namespace

ParticipantReading::ParticipantReading(const core::StudyStore& store, MovementOptions options,
                                       std::string participant)
    : store_(store), options_(std::move(options)) {
  found_.participant = std::move(participant);
}

void ParticipantReading::read_session(const core::SessionRow& session) {
  if (const auto height_m = body_height_m_of(store_, session.session)) {
    found_.body_height_m = height_m;
  }
  found_.surface_height_m =
      options_.surface_height_m ? options_.surface_height_m : surface_height_m_of(session);
  if (!session.recorded) {
    found_.reason = "no samples were kept, only summaries of strokes";
    return;
  }
  const std::filesystem::path file = store_.recording_file(session.session);
  if (!std::filesystem::exists(file)) {
    found_.reason = "the recording is missing";
    return;
  }
  const core::RecordingReader reader(file);
  if (reader.last_tick() < 0 || !(reader.rate_hz() > 0.0)) {
    found_.reason = "the recording is empty";
    return;
  }
  any_recording_ = true;
  found_.missing_ticks += reader.missing_ticks();
  read_samples(reader, ramp_s_of(store_, session),
               presentations_of(store_, session.session, options_.explored));
}

void ParticipantReading::read_samples(const core::RecordingReader& reader, double ramp_s,
                                      const std::vector<PlannedPresentation>& planned) {
  if (planned.empty()) return;
  const double rate_hz = reader.rate_hz();
  TrajectoryTaker trajectories(rate_hz);
  PresentationCursor cursor(
      planned,
      {.strokes = {.period_s = 1.0 / rate_hz,
                   .hysteresis_m = options_.hysteresis_m,
                   .rest_speed_m_per_s = options_.rest_speed_m_per_s,
                   .shortest_pause_s = options_.shortest_pause_s},
       .forward = options_.forward ? unit(*options_.forward) : std::array{1.0, 0.0},
       .ramp_ticks = std::llround(ramp_s * rate_hz),
       .has_joints = reader.has_joints()},
      !options_.forward, trajectories,
      [this](const PlannedPresentation& one, PresentationMeter::Result result) {
        take(one, std::move(result));
      });
  std::int64_t last_tick = 0;
  for (const PlannedPresentation& one : planned) {
    last_tick = std::max(last_tick, one.movement.last_tick);
  }
  reader.read(planned.front().movement.first_tick, last_tick,
              [&cursor](const core::Sample& sample) { cursor.feed(sample); });
  found_.num_samples += cursor.finish();
  for (Trajectory& one : trajectories.finish()) found_.trajectories.push_back(std::move(one));
}

void ParticipantReading::take(const PlannedPresentation& planned,
                              PresentationMeter::Result result) {
  const PresentationMovement& movement = result.movement;
  const bool is_free = movement.interval == "free_space";
  if (movement.trial > 0) {
    Trial& trial = trials_[{movement.session, movement.trial}];
    trial.movement.session = movement.session;
    trial.movement.trial = movement.trial;
    trial.movement.block = movement.block;
    trial.movement.repetition = movement.repetition;
    trial.movement.marks.add(movement.marks);
    if (!is_free) {
      // Only conditions have its curves.
      trial.sums.strokes.add(result.sums.strokes);
      trial.sums.height_m += result.sums.height_m;
      trial.sums.num_ticks += result.sums.num_ticks;
    }
  }
  const bool is_explored = movement.block.empty();
  if (!is_free && !is_explored) {
    add_to({false, movement.block, movement.medium, std::nullopt}, result);
  }
  if (planned.is_level) {
    add_to({is_explored, movement.block, movement.medium, movement.intensity}, result);
  }
  found_.presentations.push_back(std::move(result.movement));
}

void ParticipantReading::add_to(const ConditionKey& key,
                                const PresentationMeter::Result& result) {
  Condition& condition = conditions_[key];
  ++condition.num_presentations;
  condition.num_marked += result.movement.marks.any() ? 1 : 0;
  condition.sums.add(result.sums);
}

ParticipantMovement ParticipantReading::finish() {
  if (any_recording_) found_.reason.clear();
  for (auto& [key, trial] : trials_) {
    trial.movement.strokes = trial.sums.strokes.means();
    trial.movement.mean_height_m = trial.sums.mean_height_m();
    found_.trials.push_back(std::move(trial.movement));
  }
  for (const auto& [key, condition] : conditions_) {
    const auto& [explored, block, medium, intensity] = key;
    ConditionMovement movement{.block = block,
                               .medium = medium,
                               .intensity = intensity,
                               .num_presentations = condition.num_presentations,
                               .num_marked = condition.num_marked,
                               .strokes = condition.sums.strokes.means(),
                               .mean_height_m = condition.sums.mean_height_m(),
                               .curves = condition.sums.curves.curves(),
                               .force = condition.sums.force.by_speed()};
    if (movement.mean_height_m && found_.body_height_m && found_.surface_height_m) {
      movement.hand_height_ratio =
          (*movement.mean_height_m + *found_.surface_height_m) / *found_.body_height_m;
    }
    found_.conditions.push_back(std::move(movement));
  }
  return std::move(found_);
}

}  // namespace jnd::analysis
