#include "app/session/running_session.h"

#include <algorithm>
#include <memory>

#include "app/profile/profile_choice.h"
#include "app/session/session_setup.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/safety/fault.h"
#include "core/storage/flight_record.h"
#include "core/storage/recording.h"
#include "experiments/procedures/stimulus.h"

namespace jnd::app {
namespace {

using namespace experiments;

/// The last tick of the recording, after which a resumed recording continues; -1 if there is
/// none.
std::int64_t last_recorded_tick(const core::StudyStore& store, std::int64_t session) {
  const std::filesystem::path file = store.recording_file(session);
  return std::filesystem::exists(file) ? core::RecordingReader(file).last_tick() : -1;
}

std::int64_t last_tick_in(const std::vector<core::EventRow>& events) {
  std::int64_t last = -1;
  for (const core::EventRow& event : events) {
    // A first tick was still in the future when its event was stored.
    last = std::max({last, event.first_tick.value_or(0) - 1, event.last_tick.value_or(-1)});
  }
  return last;
}

/// A simulated session continues in its own time. Acts after its visits, such as the exclusion
/// of a trial, have other times and do not count.
std::int64_t last_time_ns(const std::vector<core::EventRow>& events) {
  const auto last =
      std::find_if(events.rbegin(), events.rend(), [](const core::EventRow& event) {
        return event.kind != "trial_excluded" && event.kind != "trial_included" &&
               event.kind != "unblinded";
      });
  return last == events.rend() ? 0 : last->time_ns;
}

Cell cell_of_session(const RunningSession::Parameters& running) {
  return cell_from_text(running.study, running.store.session(running.session).cells);
}

std::vector<DurationBucket> buckets_of(const device::DurationSummary& durations) {
  std::vector<DurationBucket> buckets;
  for (const device::DurationSummary::Bucket& bucket : durations.buckets) {
    buckets.push_back(
        {.up_to_ns = bucket.end_ns, .count = static_cast<std::int64_t>(bucket.count)});
  }
  return buckets;
}

}  // namespace

void RunningSession::StoredLog::append(const core::Commit& commit) {
  try {
    running_.apparatus_.commit(running_.parameters_.store, commit);
  } catch (const core::Error& error) {
    throw StorageError(error.what());
  }
  if (running_.pulses_) running_.pulses_->tell(commit.event);
  if (running_.streams_) running_.streams_->tell(commit.event);
  if (running_.parameters_.on_event) running_.parameters_.on_event(commit.event);
}

RunningSession::RunningSession(const Parameters& parameters)
    : parameters_(parameters),
      recorded_samples_(parameters.store.session(parameters.session).recorded),
      history_(parameters.store.events(parameters.session)),
      recorded_tick_(last_recorded_tick(parameters.store, parameters.session)),
      streams_(streams_asked_for()),
      sound_(sound_asked_for()),
      pulses_(pulses_asked_for()),
      apparatus_(parameters.laboratory != nullptr
                     ? Apparatus(apparatus_parameters(), *parameters.laboratory)
                     : Apparatus(apparatus_parameters())),
      session_({.session = parameters.session,
                .seed = parameters.store.session(parameters.session).seed,
                .stages = stages_of_session(parameters.study,
                                            parameters.store.session(parameters.session).cells),
                .cell = cell_of_session(parameters),
                .fields = field_values(parameters.study, cell_of_session(parameters)),
                .limits = parameters.study.session_limits},
               history_, log_, apparatus_.clock()) {}

Apparatus::Parameters RunningSession::apparatus_parameters() const {
  Apparatus::Parameters apparatus = parameters_.apparatus;
  apparatus.allow_no_realtime |=
      may_lack_rights(parameters_.store.session(parameters_.session));
  const std::string profile =
      parameters_.store.session(parameters_.session).device_profile_sha256;
  if (!profile.empty()) {
    apparatus.profile =
        std::make_shared<const KnownProfile>(stored_profile(parameters_.store, profile));
  }
  // A session that never started cannot end; it begins.
  const bool only_ends = parameters_.only_ends && !history_.empty();
  apparatus.wants_profile = !only_ends && asks_for_force(parameters_.study);
  apparatus.arm &= !only_ends;
  apparatus.rate_hz = parameters_.study.device.rate_hz;
  apparatus.ramp_s = parameters_.study.device.ramp_s;
  apparatus.immersion = parameters_.study.device.immersion;
  apparatus.surroundings = experiments::surroundings_of(parameters_.study.device);
  apparatus.force_map = experiments::force_map_of(parameters_.study.device);
  apparatus.first_tick = std::max(recorded_tick_, last_tick_in(history_)) + 1;
  apparatus.first_time_ns = last_time_ns(history_);
  if (streams_) {
    apparatus.on_sample = [streams = streams_.get(),
                           visit = apparatus.on_sample](const core::Sample& sample) {
      streams->take(sample);
      if (visit) visit(sample);
    };
  }
  if (recorded_samples_) {
    apparatus.recording = parameters_.store.recording_file(parameters_.session);
  }
  return apparatus;
}

std::unique_ptr<SessionStreams> RunningSession::streams_asked_for() const {
  if (!parameters_.streams.any() || !parameters_.apparatus.realtime) return nullptr;
  const Study& study = parameters_.study;
  core::StudyStore& store = parameters_.store;
  return std::make_unique<SessionStreams>(SessionStreams::Parameters{
      .wanted = parameters_.streams,
      .facts = {.study_id = store.study_id(),
                .study = study.name,
                .session = parameters_.session,
                .program_version = JND_VERSION},
      .rate_hz = study.device.rate_hz,
      .hides_levels = study.blinding == Blinding::kDouble && !store.unblinded(),
      .recording = store.recording_file(parameters_.session)});
}

std::unique_ptr<SessionSound> RunningSession::sound_asked_for() const {
  if (!parameters_.sound || parameters_.only_ends) return nullptr;
  return std::make_unique<SessionSound>(
      SessionSound::Parameters{.study = parameters_.study,
                               .choice = *parameters_.sound,
                               .seed = parameters_.store.session(parameters_.session).seed});
}

std::unique_ptr<SessionPulses> RunningSession::pulses_asked_for() const {
  if (!parameters_.markers.any() || !parameters_.apparatus.realtime) return nullptr;
  return std::make_unique<SessionPulses>(SessionPulses::Parameters{
      .wanted = parameters_.markers, .codes = parameters_.study.markers});
}

void RunningSession::begin(const std::string& choice, const std::string& language) {
  if (session_.state().started) {
    const std::int64_t last_known = session_.state().last_tick;
    session_.resume(choice, last_known + 1, std::max(recorded_tick_, last_known));
  } else {
    session_.start(language);
  }
  follow_streams();
  follow_markers();
  const device::RealtimeThread* thread = apparatus_.realtime_thread();
  if (thread == nullptr || session_.state().ended) return;
  const device::RealtimeReport& given = thread->report();
  session_.loop_started({.scheduler = given.scheduler,
                         .memory_locked = given.memory_locked,
                         .cpus = given.cpus,
                         .first_tick = apparatus_.next_tick(),
                         .device = apparatus_.device_told()});
}

void RunningSession::keep_fitting(const std::map<std::string, std::string>& fitting) {
  constexpr double kUntilItIsMeasuredS = 0.05;
  if (apparatus_.telemetry().num_ticks == 0) apparatus_.run_for(kUntilItIsMeasuredS);
  const core::Sample& now = apparatus_.telemetry().sample;
  FittingKept kept{.fitting = fitting};
  for (std::size_t point = 0; point < core::kContactPointNames.size(); ++point) {
    if ((now.attached_bits >> point & 1U) == 0) continue;
    const std::string name(core::kContactPointNames[point]);
    kept.held.push_back(name);
    kept.neutral_pose_m[name] = now.tip_position_m[point];
  }
  session_.fitting_kept(kept);
}

void RunningSession::keep_timing() {
  if (sound_) sound_->measure(session_);
  const device::RealtimeThread* thread = apparatus_.realtime_thread();
  if (thread == nullptr) return;
  const device::LoopTimingSummary timing = device::summary_of(thread->timing());
  session_.loop_measured({.num_ticks = timing.num_ticks,
                          .missed_ticks = timing.missed_ticks,
                          .num_dropped_samples = static_cast<std::int64_t>(
                              apparatus_.telemetry().num_dropped_samples),
                          .max_lateness_ns = timing.lateness.max_ns,
                          .max_tick_cost_ns = timing.tick_cost.max_ns,
                          .lateness = buckets_of(timing.lateness),
                          .tick_cost = buckets_of(timing.tick_cost),
                          .device_clock = apparatus_.telemetry().device_clock});
}

void RunningSession::keep_arming(const std::string& by) {
  if (apparatus_.realtime_thread() == nullptr) return;
  const core::Telemetry& now = apparatus_.telemetry();
  if (told_arming_ == now.arming) return;
  told_arming_ = now.arming;
  std::string cause = apparatus_.is_simulated() ? "simulated device, armed by the program" : by;
  if (now.arming == core::Arming::kFaulted) cause = name(now.fault);
  if (now.arming == core::Arming::kDisarmed) cause = "nobody has armed it";
  session_.arming_changed(std::string(name(now.arming)), cause);
}

void RunningSession::follow_streams() {
  if (streams_ && session_.state().started && !session_.state().ended) {
    streams_->follow(session_);
  }
}

void RunningSession::follow_markers() {
  if (pulses_ && session_.state().started && !session_.state().ended) {
    pulses_->follow(session_);
  }
}

void RunningSession::follow_sound() {
  if (sound_ && session_.state().started && !session_.state().ended) sound_->follow(session_);
}

void RunningSession::close_sound() {
  if (sound_ && session_.state().started && !session_.state().ended) sound_->close(session_);
}

std::string RunningSession::markers_problem() const {
  return pulses_ ? pulses_->problem() : "";
}

void RunningSession::close_streams() {
  if (!session_.state().started || session_.state().ended) return;
  if (pulses_) pulses_->close(session_);
  if (streams_) streams_->close(session_);
}

void RunningSession::keep_fault() {
  const core::Fault fault = apparatus_.telemetry().fault;
  if (!core::is_failure(fault)) return;
  session_.fault(apparatus_.fault_words(fault));
  const std::vector<core::Sample> last_second = apparatus_.flight_record();
  if (last_second.empty()) return;
  try {
    core::write_flight_record(parameters_.store.recording_file(parameters_.session),
                              last_second);
  } catch (const core::Error& error) {
    session_.note(error.what());
  }
}

}  // namespace jnd::app
