#include "app/laboratory_run.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

#include "app/apparatus.h"
#include "core/error.h"
#include "core/random_stream.h"
#include "core/storage/recording.h"
#include "experiments/order/counterbalance.h"
#include "experiments/participants/simulated_participant.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/session/session.h"
#include "experiments/session/stimulus.h"

namespace jnd::app {
namespace {

using namespace experiments;

/// Thrown out of the middle of a session that was asked to stop.
struct Cancelled {};

core::SessionRow session_row(const core::StudyStore& store, std::int64_t session) {
  for (const core::SessionRow& row : store.sessions()) {
    if (row.session == session) return row;
  }
  throw core::Error(store.folder().string() + ": expected session " + std::to_string(session) +
                    ", found none of that number");
}

std::vector<const Stage*> stages_for(const Study& study, const std::string& cells) {
  std::vector<const Stage*> stages;
  for (const StageInstance& instance : stages_of(study, cell_from_text(study, cells))) {
    stages.push_back(instance.stage);
  }
  return stages;
}

/// The recorded tick after which a resumed session goes on, and how many no event knows of.
struct RecordedEnd {
  std::int64_t last_tick = -1;
};

RecordedEnd recorded_end(const core::StudyStore& store, std::int64_t session) {
  RecordedEnd end;
  const std::filesystem::path file = store.recording_file(session);
  if (!std::filesystem::exists(file)) return end;
  for (const core::RecordingChunk& chunk : core::RecordingReader(file).chunks()) {
    end.last_tick = std::max(end.last_tick, chunk.first_tick + chunk.num_samples - 1);
  }
  return end;
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
        recorded_(recorded_end(run.store, run.session)),
        apparatus_(apparatus_parameters(), run.laboratory),
        log_(run, apparatus_),
        session_({.session = run.session,
                  .seed = row.seed,
                  .stages = stages_for(run.study, row.cells)},
                 history_, log_, apparatus_.clock()) {}

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
      }
      if (!session_.state().ended) session_.complete();
      result.ended = true;
    } catch (const Cancelled&) {
      session_.pause("stopped by the operator");
    }
    result.num_ticks = apparatus_.next_tick();
    return result;
  }

 private:
  struct Felt {
    double damping_n_s_per_m = 0.0;
    std::int64_t last_tick = 0;
    double duration_s = 0.0;
  };

  Apparatus::Parameters apparatus_parameters() const {
    Apparatus::Parameters parameters;
    parameters.rate_hz = run_.study.device.rate_hz;
    parameters.ramp_s = run_.study.device.ramp_s;
    parameters.immersion = run_.study.device.immersion;
    parameters.home_height_m = participant_.home_height_m();
    parameters.first_tick = std::max(recorded_.last_tick, last_tick_in(history_)) + 1;
    if (!history_.empty()) parameters.first_time_ns = history_.back().time_ns;
    parameters.realtime = run_.realtime;
    if (recorded_samples_) parameters.recording = run_.store.recording_file(run_.session);
    parameters.durability = run_.durability;
    return parameters;
  }

  static std::int64_t last_tick_in(const std::vector<core::EventRow>& events) {
    std::int64_t last = -1;
    for (const core::EventRow& event : events) {
      last = std::max({last, event.first_tick.value_or(-1), event.last_tick.value_or(-1)});
    }
    return last;
  }

  void begin() {
    if (!session_.state().started) return session_.start();
    const std::int64_t last_known = session_.state().last_tick;
    session_.resume(run_.choice, last_known + 1, std::max(recorded_.last_tick, last_known));
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

  void stop_if_cancelled() const {
    if (run_.is_cancelled && run_.is_cancelled()) throw Cancelled{};
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
      explore_one({.setting = item.setting, .duration_s = 5.0});
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
    while (const std::optional<std::int64_t> trial = session_.state().current_trial()) {
      stop_if_cancelled();
      rest(block.free_space_between_s);
      session_.start_trial(apparatus_.next_tick());
      run_trial(block, *trial);
      trial_progress();
    }
  }

  void answer_item(const std::string& item, const std::string& answer) {
    stop_if_cancelled();
    // A resumed stage goes on after the items that are answered.
    if (session_.state().answers.contains({session_.state().stage, item})) return;
    session_.answer_item(item, answer);
  }

  void explore_media(const std::vector<Exploration>& media) {
    for (const Exploration& exploration : media) explore_one(exploration);
  }

  void explore_one(const Exploration& exploration) {
    stop_if_cancelled();
    const std::int64_t first_tick = apparatus_.next_tick();
    apparatus_.render(amounts_of(exploration.setting));
    StrokeIntent intent = participant_.strokes("");
    if (exploration.setting.medium == "solid") intent.height_m = -0.005;
    apparatus_.begin_strokes(plan_of(intent),
                             stroke_stream(session_.state().last_sequence, 0, 0));
    apparatus_.run_for(exploration.duration_s);
    session_.explored(exploration.setting.medium, exploration.setting.intensity, first_tick,
                      apparatus_.next_tick() - 1);
  }

  /// Free space, hand at rest at home.
  void rest(double duration_s) {
    apparatus_.render(core::free_space());
    apparatus_.go_home();
    apparatus_.run_for(std::max(duration_s, 2.0 * run_.laboratory.arm.home_s));
  }

  device::StrokePlan plan_of(const StrokeIntent& intent) const {
    const Laboratory::Movement& habit = run_.laboratory.movement;
    return {.amplitude_m = intent.amplitude_m,
            .max_speed_m_per_s = intent.max_speed_m_per_s,
            .height_m = intent.height_m,
            .lift_m = habit.lift_m,
            .amplitude_sd_ratio = habit.stroke_amplitude_sd_ratio,
            .speed_sd_ratio = habit.stroke_speed_sd_ratio,
            .height_sd_m = habit.stroke_height_sd_m};
  }

  core::RandomStream stroke_stream(std::int64_t trial, std::int64_t attempt,
                                   std::int64_t presentation) const {
    return {session_.seed(), "stroke", {trial, attempt, presentation}};
  }

  /// Until the strokes are done and the hand has visibly turned, or far too much time is over.
  void run_strokes(const StrokeIntent& intent) {
    constexpr double kGlanceS = 0.020;  // How often the person looks whether it is enough.
    const double limit_s = 3.0 * static_cast<double>(intent.num_strokes + 1) * intent.period_s;
    double elapsed_s = 0.0;
    while (apparatus_.strokes_finished() < intent.num_strokes && elapsed_s < limit_s) {
      apparatus_.run_for(kGlanceS);
      elapsed_s += kGlanceS;
    }
    apparatus_.run_for(0.2 + 0.1 * intent.period_s);
  }

  Felt present(const Block& block, const std::string& interval) {
    const std::int64_t number = *session_.state().current_trial();
    session_.begin_presentation(interval, apparatus_.next_tick());
    const TrialState& trial = session_.state().trial(number);
    const core::MediumAmounts amounts =
        amounts_of(interval == "free_space" ? "free_space" : block.medium,
                   trial.presentations.back().intensity);
    const StrokeIntent intent = participant_.strokes(block.procedure);
    const std::int64_t limited_before =
        static_cast<std::int64_t>(apparatus_.telemetry().num_limited_ticks);
    apparatus_.render(amounts);
    apparatus_.begin_strokes(
        plan_of(intent), stroke_stream(number, trial.attempt,
                                       static_cast<std::int64_t>(trial.presentations.size())));
    apparatus_.run_for(run_.study.device.ramp_s);  // Felt is what comes after the ramp.
    const core::ContactSums before = apparatus_.telemetry().contact_sums;
    apparatus_.meter_strokes();
    run_strokes(intent);
    const core::ContactSums sums = apparatus_.telemetry().contact_sums - before;
    const analysis::StrokeSummary strokes = apparatus_.finish_strokes();

    PresentationSummary summary;
    summary.stroke_width_m = strokes.stroke_width_m;
    summary.max_speed_m_per_s = strokes.max_speed_m_per_s;
    summary.mean_height_m = strokes.mean_height_m;
    summary.num_strokes = strokes.num_strokes;
    summary.delivered_damping_n_s_per_m = sums.delivered_damping_n_s_per_m();
    if (amounts.quadratic_kg_per_m == 0.0) {
      summary.commanded_damping_n_s_per_m = amounts.damping_n_s_per_m;
    }
    summary.limited_ticks =
        static_cast<std::int64_t>(apparatus_.telemetry().num_limited_ticks) - limited_before;
    // What was delivered and the device's own viscosity; dry friction is felt as something
    // else.
    const std::int64_t last_tick = apparatus_.next_tick() - 1;
    const Felt felt{
        .damping_n_s_per_m = sums.delivered_damping_n_s_per_m() +
                             run_.laboratory.device.mechanical_viscosity_n_s_per_m,
        .last_tick = last_tick,
        .duration_s =
            static_cast<double>(
                last_tick - session_.state().trial(number).presentations.back().first_tick) /
            run_.study.device.rate_hz};
    session_.end_presentation(felt.last_tick, summary);
    return felt;
  }

  Moment moment(const Block& block) const {
    const std::int64_t number = *session_.state().current_trial();
    const TrialState& trial = session_.state().trial(number);
    const auto per_repetition = static_cast<std::int64_t>(block.intensities.size());
    return {.trial = number,
            .attempt = trial.attempt,
            .presentation = static_cast<std::int64_t>(trial.presentations.size()),
            .trial_in_block =
                (trial.planned.repetition - 1) * per_repetition + trial.planned.position};
  }

  double read(const Felt& felt, const Block& block) const {
    return participant_.perceiver().reading_ln(felt.damping_n_s_per_m, moment(block));
  }

  void run_trial(const Block& block, std::int64_t trial) {
    const TrialForm form = procedure_named(block.procedure).form();
    if (form.adjustable) return produce(block, trial);
    if (form.answer == AnswerKind::kYesNo) return compare(block);
    estimate(block, trial);
  }

  void estimate(const Block& block, std::int64_t trial) {
    double sum_ln = 0.0;
    int looks = 0;
    Felt felt;
    do {
      felt = present(block, "test");
      sum_ln += read(felt, block);
      ++looks;
    } while (participant_.perceiver().looks_again(moment(block)));
    std::optional<double> previous;
    if (trial > 1) {
      const TrialState& before = session_.state().trial(trial - 1);
      if (before.stage == session_.state().stage) previous = before.response;
    }
    session_.answer(
        participant_.perceiver().estimate_percent(sum_ln / looks, moment(block), previous),
        felt.duration_s, felt.last_tick);
  }

  void compare(const Block& block) {
    double reference_ln = 0.0;
    double test_ln = 0.0;
    int looks = 0;
    Felt felt;
    do {
      felt = present(block, "reference");
      reference_ln += read(felt, block);
      felt = present(block, "test");
      test_ln += read(felt, block);
      ++looks;
    } while (participant_.perceiver().looks_again(moment(block)));
    const bool thicker = participant_.perceiver().says_thicker(
        test_ln / looks, reference_ln / looks, moment(block));
    session_.answer(thicker ? 1.0 : 0.0, felt.duration_s, felt.last_tick);
  }

  void produce(const Block& block, std::int64_t trial) {
    constexpr int kMaxSteps = 60;  // Then a person gives up and takes what there is.
    const double target_percent = session_.state().trial(trial).planned.target_percent.value();
    // What is felt now, with the noise of all looks at this trial averaged: who steps on and on
    // knows better where they are than who felt it once.
    double noise_ln = 0.0;
    int looks = 0;
    double duration_s = 0.0;
    Felt felt;
    const auto look = [&] {
      felt = present(block, "test");
      duration_s += felt.duration_s;
      const double felt_ln = std::log(std::max(felt.damping_n_s_per_m, 1e-6));
      noise_ln += read(felt, block) - felt_ln;
      ++looks;
      return felt_ln + noise_ln / looks;
    };
    double reading_ln = look();
    const double first_ln = reading_ln;
    using Wish = Perceiver::Wish;
    Wish last_wish = Wish::kMatches;
    for (int step = 0; step < kMaxSteps; ++step) {
      const Wish wish =
          participant_.perceiver().wish(reading_ln, first_ln, target_percent, moment(block));
      if (wish == Wish::kMatches) break;
      // Back and forth over the target by the smallest step: it does not get closer than this.
      if ((last_wish == Wish::kRaiseFine && wish == Wish::kLowerFine) ||
          (last_wish == Wish::kLowerFine && wish == Wish::kRaiseFine)) {
        break;
      }
      last_wish = wish;
      const bool raise = wish == Wish::kRaiseFine || wish == Wish::kRaiseCoarse;
      const bool coarse = wish == Wish::kRaiseCoarse || wish == Wish::kLowerCoarse;
      if (!session_.adjust(raise ? Direction::kRaise : Direction::kLower,
                           coarse ? StepSize::kCoarse : StepSize::kFine)) {
        break;
      }
      reading_ln = look();
    }
    session_.answer(0.0, duration_s, felt.last_tick);
  }

  const LaboratoryRun& run_;
  bool recorded_samples_;
  std::vector<core::EventRow> history_;
  SimulatedParticipant participant_;
  RecordedEnd recorded_;
  Apparatus apparatus_;
  StoredLog log_;
  Session session_;
};

}  // namespace

LaboratoryRunResult run_laboratory(const LaboratoryRun& run) {
  const core::SessionRow row = session_row(run.store, run.session);
  Visit visit(run, row);
  return visit.play();
}

}  // namespace jnd::app
