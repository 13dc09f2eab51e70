#include "app/session/laboratory_run.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "app/session/missing_force.h"
#include "app/session/running_session.h"
#include "app/session/trial_player.h"
#include "core/error.h"
#include "core/safety/fault.h"
#include "experiments/participants/simulated_participant.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/session/session.h"

namespace jnd::app {
namespace {

using namespace experiments;

/// Stored as the reason why a real device was armed.
constexpr char kArmedBy[] = "armed by --arm";

/// Plays the experimenter and the participant of one session.
class SimulatedSession {
 public:
  explicit SimulatedSession(const LaboratoryRun& run)
      : run_(run),
        participant_(run.laboratory, run.store.session(run.session).seed),
        running_({.store = run.store,
                  .session = run.session,
                  .study = run.study,
                  .apparatus = {.device = run.store.session(run.session).device,
                                .home_height_m = participant_.home_height_m(),
                                .realtime = run.realtime,
                                .allow_no_realtime = run.allow_no_realtime,
                                .arm = run.arm,
                                .before_arming = run.before_arming,
                                .shadow_guards = run.shadow_guards,
                                .durability = run.durability,
                                .injected_faults = run.injected_faults},
                  .laboratory = &run.laboratory,
                  .on_event = run.on_event,
                  .only_ends = run.choice == "end",
                  .streams = run.streams,
                  .markers = run.markers}),
        session_(running_.session()),
        player_(run, running_.apparatus(), session_, participant_) {}

  LaboratoryRunResult play() {
    LaboratoryRunResult result;
    result.realtime = running_.apparatus().realtime();
    try {
      const bool is_new = !session_.state().started;
      running_.begin(run_.choice, run_.language);
      if (is_new && !run_.fitting.empty()) running_.keep_fitting(run_.fitting);
      if (run_.shadow_guards && !session_.state().ended) {
        session_.note("the guards of the loop only count what they would have done");
      }
      running_.keep_arming(kArmedBy);
      while (!session_.state().ended && session_.current_stage() != nullptr) {
        if (!session_.state().stage_open) session_.enter_stage();
        stage_progress();
        std::visit([this](const auto& content) { run_stage(content); },
                   session_.current_stage()->content);
        session_.finish_stage();
        running_.keep_arming(kArmedBy);
        running_.keep_timing();
        running_.follow_streams();
        running_.follow_markers();
      }
      running_.close_streams();
      if (!session_.state().ended) session_.complete();
      result.ended = true;
      result.ended_early = !session_.state().completed;
      result.cautions = std::move(cautions_);
      const SessionState& state = session_.state();
      if (state.num_without_force > 0) {
        result.cautions.push_back(
            missing_force_words(state.num_without_force, state.missing_force_cause));
      }
    } catch (const Cancelled&) {
      // The medium is taken away first, because the disk may take its time.
      running_.apparatus().render(core::free_space());
      running_.keep_timing();
      running_.close_streams();
      session_.pause("stopped by the operator");
    } catch (const core::Error&) {
      running_.apparatus().render(core::free_space());
      // A fault of the loop is an event of the session, even if it also ends the session.
      if (core::is_failure(running_.apparatus().telemetry().fault)) {
        running_.keep_arming(kArmedBy);
        running_.keep_fault();
        running_.keep_timing();
      }
      throw;
    }
    result.num_ticks = running_.apparatus().next_tick();
    result.guards = running_.apparatus().telemetry().guards;
    return result;
  }

 private:
  void stage_progress() const {
    if (!run_.on_progress) return;
    run_.on_progress(static_cast<double>(session_.state().stage) /
                     static_cast<double>(session_.stages().size()));
  }

  void trial_progress() const {
    if (!run_.on_progress) return;
    const SessionState& state = session_.state();
    double drawn = 0.0, answered = 0.0;
    for (const TrialState& trial : state.trials) {
      if (!state.is_under_way(trial.stage)) continue;
      drawn += 1.0;
      answered += trial.is_answered ? 1.0 : 0.0;
    }
    const double done = drawn > 0.0 ? answered / drawn : 0.0;
    run_.on_progress((static_cast<double>(state.first_together) +
                      done * static_cast<double>(state.num_together)) /
                     static_cast<double>(session_.stages().size()));
  }

  // These run the stages, one overload for each kind. Forms and breaks take no simulated time.

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

  void run_stage(const Block&) {
    player_.answer_questions(session_.current_block_as_drawn());
    while (session_.state().current_trial()) {
      // In interleaved blocks, this is the block whose turn it is.
      const Block block = session_.current_block_as_drawn();
      player_.run_trial(block);
      player_.answer_questions(block);
      running_.follow_streams();
      running_.follow_markers();
      trial_progress();
    }
    for (const std::int64_t index : session_.current_stages()) {
      const Stage& stage = *session_.stages().at(static_cast<std::size_t>(index));
      const auto& block = std::get<Block>(stage.content);
      const std::string caution =
          procedure_named(block.procedure).caution(block, session_.state().answered_in(index));
      if (!caution.empty()) cautions_.push_back(stage.name + ": " + caution);
    }
  }

  void answer_item(const std::string& item, const std::string& answer) {
    stop_if_cancelled(run_);
    // A resumed stage goes on after the items that were answered.
    if (!is_answered(item)) session_.answer_item(item, answer);
  }

  [[nodiscard]] bool is_answered(const std::string& item) const {
    return session_.state().answers.contains({session_.state().stage, item});
  }

  /// Explores media; a resumed stage goes on after those that were explored.
  void explore_media(const std::vector<Exploration>& media) {
    const auto begin =
        std::min(static_cast<std::size_t>(session_.state().num_explored), media.size());
    for (std::size_t medium = begin; medium < media.size(); ++medium) {
      player_.explore(media[medium]);
    }
  }

  const LaboratoryRun& run_;
  SimulatedParticipant participant_;
  RunningSession running_;
  Session& session_;
  TrialPlayer player_;
  std::vector<std::string> cautions_;
};

}  // namespace

LaboratoryRunResult run_laboratory(const LaboratoryRun& run) {
  SimulatedSession simulated(run);
  return simulated.play();
}

}  // namespace jnd::app
