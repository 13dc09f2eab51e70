#include "app/laboratory_run.h"

#include <algorithm>
#include <vector>

#include "app/apparatus.h"
#include "app/session_setup.h"
#include "app/trial_player.h"
#include "core/error.h"
#include "core/safety/fault.h"
#include "core/storage/recording.h"
#include "experiments/participants/simulated_participant.h"
#include "experiments/session/session.h"

namespace jnd::app {
namespace {

using namespace experiments;

/// Where a resumed recording goes on.
std::int64_t last_recorded_tick(const core::StudyStore& store, std::int64_t session) {
  const std::filesystem::path file = store.recording_file(session);
  return std::filesystem::exists(file) ? core::RecordingReader(file).last_tick() : -1;
}

/// A simulated session goes on in its own time, whenever somebody excluded a trial of it.
std::int64_t last_time_ns(const std::vector<core::EventRow>& events) {
  const auto last =
      std::find_if(events.rbegin(), events.rend(), [](const core::EventRow& event) {
        return event.kind != "trial_excluded" && event.kind != "trial_included" &&
               event.kind != "unblinded";
      });
  return last == events.rend() ? 0 : last->time_ns;
}

/// Events go through the apparatus, which syncs the recording first.
class StoredLog final : public EventLog {
 public:
  StoredLog(const LaboratoryRun& run, Apparatus& apparatus)
      : run_(run), apparatus_(apparatus) {}

  void append(const core::Commit& commit) override {
    apparatus_.commit(run_.store, commit);
    if (run_.on_event) run_.on_event(commit.event);
  }

 private:
  const LaboratoryRun& run_;
  Apparatus& apparatus_;
};

/// Plays the experimenter and the participant of one session.
class Visit {
 public:
  Visit(const LaboratoryRun& run, const core::SessionRow& row)
      : run_(run),
        recorded_samples_(row.recorded),
        history_(run.store.events(run.session)),
        participant_(run.laboratory, row.seed),
        recorded_tick_(last_recorded_tick(run.store, run.session)),
        apparatus_(apparatus_parameters(), run.laboratory),
        log_(run, apparatus_),
        session_({.session = run.session,
                  .seed = row.seed,
                  .stages = stages_of_session(run.study, row.cells)},
                 history_, log_, apparatus_.clock()),
        player_(run, apparatus_, session_, participant_) {}

  LaboratoryRunResult play() {
    LaboratoryRunResult result;
    result.realtime = apparatus_.realtime();
    try {
      begin();
      while (!session_.state().ended && session_.current_stage() != nullptr) {
        if (!session_.state().stage_open) session_.enter_stage();
        stage_progress();
        std::visit([this](const auto& content) { run_stage(content); },
                   session_.current_stage()->content);
        session_.finish_stage();
        keep_timing();
      }
      if (!session_.state().ended) session_.complete();
      result.ended = true;
    } catch (const Cancelled&) {
      keep_timing();
      session_.pause("stopped by the operator");
    } catch (const core::Error&) {
      keep_fault();
      throw;
    }
    result.num_ticks = apparatus_.next_tick();
    return result;
  }

 private:
  /// A fault of the loop is an event of the session, whatever else it ends.
  void keep_fault() {
    const core::Fault fault = apparatus_.telemetry().fault;
    if (fault == core::Fault::kNone) return;
    session_.fault(std::string(words(fault)));
    keep_timing();
  }

  Apparatus::Parameters apparatus_parameters() const {
    Apparatus::Parameters parameters;
    parameters.rate_hz = run_.study.device.rate_hz;
    parameters.ramp_s = run_.study.device.ramp_s;
    parameters.immersion = run_.study.device.immersion;
    parameters.home_height_m = participant_.home_height_m();
    parameters.first_tick = std::max(recorded_tick_, last_tick_in(history_)) + 1;
    parameters.first_time_ns = last_time_ns(history_);
    parameters.realtime = run_.realtime;
    parameters.allow_no_realtime = run_.allow_no_realtime;
    if (recorded_samples_) parameters.recording = run_.store.recording_file(run_.session);
    parameters.durability = run_.durability;
    return parameters;
  }

  static std::int64_t last_tick_in(const std::vector<core::EventRow>& events) {
    std::int64_t last = -1;
    for (const core::EventRow& event : events) {
      // A first tick was still to come when its event was stored.
      last = std::max({last, event.first_tick.value_or(0) - 1, event.last_tick.value_or(-1)});
    }
    return last;
  }

  void begin() {
    begin_session();
    const device::RealtimeThread* thread = apparatus_.realtime_thread();
    if (thread == nullptr || session_.state().ended) return;
    const device::RealtimeReport& given = thread->report();
    session_.loop_started({.scheduler = given.scheduler,
                           .memory_locked = given.memory_locked,
                           .cpus = given.cpus,
                           .first_tick = apparatus_.next_tick()});
  }

  /// Cumulative since the loop was started; after every stage, so that a crash costs one.
  void keep_timing() {
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
                            .tick_cost = buckets_of(timing.tick_cost)});
  }

  static std::vector<DurationBucket> buckets_of(const device::DurationSummary& durations) {
    std::vector<DurationBucket> buckets;
    for (const device::DurationSummary::Bucket& bucket : durations.buckets) {
      buckets.push_back(
          {.up_to_ns = bucket.end_ns, .count = static_cast<std::int64_t>(bucket.count)});
    }
    return buckets;
  }

  void begin_session() {
    if (!session_.state().started) return session_.start();
    const std::int64_t last_known = session_.state().last_tick;
    session_.resume(run_.choice, last_known + 1, std::max(recorded_tick_, last_known));
  }

  void stage_progress() const {
    if (!run_.on_progress) return;
    run_.on_progress(static_cast<double>(session_.state().stage) /
                     static_cast<double>(session_.stages().size()));
  }

  void trial_progress() const {
    if (!run_.on_progress) return;
    const std::int64_t stage = session_.state().stage;
    double drawn = 0.0;
    for (const TrialState& trial : session_.state().trials)
      drawn += trial.stage == stage ? 1 : 0;
    const auto answered = static_cast<double>(session_.state().answered_in(stage).size());
    run_.on_progress((static_cast<double>(stage) + (drawn > 0 ? answered / drawn : 0.0)) /
                     static_cast<double>(session_.stages().size()));
  }

  // The stages, one overload a kind. Forms and breaks take no simulated time.

  void run_stage(const Checklist& checklist) {
    for (std::size_t item = 0; item < checklist.items.size(); ++item) {
      answer_item("item_" + std::to_string(item + 1), "done");
    }
  }

  void run_stage(const Consent&) { answer_item("consent", "given"); }

  void run_stage(const Explore& explore) { explore_media(explore.media); }

  void run_stage(const Training& training) { explore_media(training.examples); }

  void run_stage(const Break&) {}

  void run_stage(const PostExperiment& post) {
    for (const PostExperimentItem& item : post.items) {
      if (is_answered(item.name)) continue;
      player_.explore({.setting = item.setting, .duration_s = 5.0});
      answer_item(item.name, participant_.answer(item));
    }
  }

  void run_stage(const Questionnaire& questionnaire) {
    for (const QuestionnaireItem& item : questionnaire.items) {
      answer_item(item.name, participant_.answer(item));
    }
  }

  void run_stage(const Counterbalance&) {
    throw core::Error("counterbalance: expected to be resolved before the session");
  }

  void run_stage(const Block& block) {
    while (session_.state().current_trial()) {
      player_.run_trial(block);
      trial_progress();
    }
  }

  void answer_item(const std::string& item, const std::string& answer) {
    stop_if_cancelled(run_);
    // A resumed stage goes on after the items that are answered.
    if (!is_answered(item)) session_.answer_item(item, answer);
  }

  [[nodiscard]] bool is_answered(const std::string& item) const {
    return session_.state().answers.contains({session_.state().stage, item});
  }

  /// A resumed stage goes on after the media that were explored.
  void explore_media(const std::vector<Exploration>& media) {
    const auto begin =
        std::min(static_cast<std::size_t>(session_.state().num_explored), media.size());
    for (std::size_t medium = begin; medium < media.size(); ++medium) {
      player_.explore(media[medium]);
    }
  }

  const LaboratoryRun& run_;
  bool recorded_samples_;
  std::vector<core::EventRow> history_;
  SimulatedParticipant participant_;
  std::int64_t recorded_tick_;
  Apparatus apparatus_;
  StoredLog log_;
  Session session_;
  TrialPlayer player_;
};

}  // namespace

LaboratoryRunResult run_laboratory(const LaboratoryRun& run) {
  const core::SessionRow row = run.store.session(run.session);
  Visit visit(run, row);
  return visit.play();
}

}  // namespace jnd::app
