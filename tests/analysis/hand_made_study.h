#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/storage/study_store.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {

/// Writes a study folder row by row, so that its results can be worked out by hand.
class HandMadeStudy {
 public:
  explicit HandMadeStudy(const std::string& protocol = R"({"name":"by_hand"})")
      : store_(folder(), core::StudyStore::Mode::kCreate, core::Durability::kAtClose),
        hash_(store_.add_protocol("by_hand.json", protocol)) {}

  [[nodiscard]] std::filesystem::path folder() const { return temporary_.path() / "x.study"; }
  [[nodiscard]] const core::StudyStore& store() const { return store_; }

  std::int64_t add(const std::string& participant, bool pilot = false,
                   const std::string& laboratory = "", const std::string& cells = "",
                   bool recorded = false) {
    trial_ = 0;
    sequence_ = 0;
    session_ = store_.add_session({.participant = participant,
                                   .protocol_sha256 = hash_,
                                   .cells = cells,
                                   .pilot = pilot,
                                   .simulated = !laboratory.empty(),
                                   .laboratory = laboratory,
                                   .rate_hz = 1000.0,
                                   .recorded = recorded});
    return session_;
  }

  /// Adds a session of a person on a device with this profile. Returns the hash of the profile.
  std::string add_measured(const std::string& participant, const std::string& profile) {
    trial_ = 0;
    sequence_ = 0;
    std::string profile_hash = store_.add_device_profile(profile);
    session_ = store_.add_session({.participant = participant,
                                   .protocol_sha256 = hash_,
                                   .device_profile_sha256 = profile_hash,
                                   .rate_hz = 1000.0,
                                   .recorded = false});
    return profile_hash;
  }

  void report_adverse_event(std::int64_t session, const std::string& text) {
    store_.add_adverse_event(session, 0, text);
  }

  /// Adds an event of this kind that has nothing but its data. Returns its sequence.
  std::int64_t happens(const std::string& kind, const std::string& data = "{}") {
    core::Commit happened = event(kind.c_str());
    happened.event.data = data;
    store_.append(happened);
    return happened.event.sequence;
  }

  /// Begins the session that was added last. `data` is the JSON of the event, which describes
  /// the participant.
  void start(const std::string& data) {
    core::Commit started = event("session_started");
    started.event.data = data;
    store_.append(started);
  }

  /// Adds to the last session an event that has nothing but its data.
  void keep(const char* kind, const std::string& data) {
    core::Commit kept = event(kind);
    kept.event.data = data;
    store_.append(kept);
  }

  /// Ends the last session by the event "session_completed" or "session_ended_early".
  void end(const char* kind) { store_.append(event(kind)); }

  /// Adds the next look with the decision "go_on" or "stop". `sessions` are those since the
  /// look before.
  void look(const std::string& decision, std::vector<std::int64_t> sessions) {
    const auto number = static_cast<std::int64_t>(store_.looks().size()) + 1;
    store_.add_look({.look = number, .decision = decision, .sessions = std::move(sessions)});
  }

  /// Adds an answered trial to the last session. Returns its number.
  std::int64_t answer(core::TrialRow row) {
    (void)draw(row);
    answer_again(std::move(row), 1);
    return trial_;
  }
  /// Adds another attempt at the trial that was answered last.
  void answer_again(core::TrialRow row, std::int64_t attempt) {
    core::Commit answered = event("trial_answered");
    answered.event.trial = trial_;
    answered.event.attempt = attempt;
    row.session = session_;
    row.trial = trial_;
    row.attempt = attempt;
    row.sequence = sequence_;
    answered.trial = std::move(row);
    store_.append(answered);
  }
  /// Adds the answer to a question after the last answered trial, for attempt 1.
  void say_after_trial(const std::string& block, const std::string& question,
                       const std::string& answer) {
    core::Commit said = event("question_answered");
    said.event.trial = trial_;
    said.question_answer = core::QuestionAnswerRow{.session = session_,
                                                   .trial = trial_,
                                                   .attempt = 1,
                                                   .sequence = sequence_,
                                                   .block = block,
                                                   .question = question,
                                                   .answer = answer};
    store_.append(said);
  }
  void undo_last_answer() {
    const std::int64_t answered = sequence_;
    core::Commit undone = event("answer_undone");
    undone.event.trial = trial_;
    undone.event.supersedes = answered;
    store_.append(undone);
  }
  /// Adds a trial without an answer to the last session. Returns its number.
  std::int64_t draw(const core::TrialRow& row) {
    core::Commit drawn = event("trials_drawn");
    drawn.design.push_back({.session = session_,
                            .trial = ++trial_,
                            .block = row.block,
                            .procedure = row.procedure,
                            .quantity = row.quantity,
                            .repetition = row.repetition,
                            .intensity = row.intensity,
                            .is_catch = row.is_catch});
    store_.append(drawn);
    return trial_;
  }
  /// Adds an event without a row, about a trial or about none.
  void happen(const char* kind, std::optional<std::int64_t> trial = {},
              const std::string& data = "") {
    core::Commit happened = event(kind);
    happened.event.trial = trial;
    if (!data.empty()) happened.event.data = data;
    store_.append(happened);
  }
  void exclude(std::int64_t trial) {
    core::Commit excluded = event("trial_excluded");
    excluded.event.trial = trial;
    store_.append(excluded);
  }
  /// Says how the hand moved in the last answered trial.
  void move(core::PresentationRow row) {
    core::Commit ended = event("presentation_ended");
    row.session = session_;
    row.trial = trial_;
    row.attempt = 1;
    row.sequence = sequence_;
    ended.presentation = std::move(row);
    store_.append(ended);
  }

  /// Adds a medium that was felt outside of trials.
  void explore(std::int64_t stage, const std::string& medium, double intensity,
               std::int64_t first_tick, std::int64_t last_tick) {
    core::Commit explored = event("medium_explored");
    explored.event.stage = stage;
    explored.event.first_tick = first_tick;
    explored.event.last_tick = last_tick;
    explored.event.intensity = intensity;
    explored.event.data = R"({"medium":")" + medium + "\"}";
    store_.append(explored);
  }

  /// Adds an answer outside of any trial.
  void say(const std::string& stage, const std::string& item, const std::string& answer) {
    core::Commit answered = event("item_answered");
    answered.answers.push_back({.session = session_,
                                .sequence = sequence_,
                                .stage = stage,
                                .item = item,
                                .answer = answer});
    store_.append(answered);
  }

  void estimate(double intensity, double percent, std::int64_t repetition = 1) {
    (void)answer({.block = "estimation",
                  .procedure = "magnitude_estimation",
                  .quantity = "scale",
                  .repetition = repetition,
                  .intensity = intensity,
                  .response = percent});
  }
  void produce(double target_percent, double set) {
    (void)answer({.block = "production",
                  .procedure = "magnitude_production",
                  .quantity = "scale",
                  .repetition = 1,
                  .intensity = set,
                  .target_percent = target_percent,
                  .response = set});
  }
  void compare(const std::string& block, double intensity, double reference, bool thicker) {
    (void)answer({.block = block,
                  .procedure = "constant_stimuli",
                  .quantity = "viscosity_pa_s",
                  .repetition = 1,
                  .intensity = intensity,
                  .reference_intensity = reference,
                  .response = thicker ? 1.0 : 0.0});
  }
  /// Adds a match: a fluid that was adjusted from `start` to `set` to feel like the fluid
  /// `standard`.
  void match(double standard, double start, double set) {
    (void)answer({.block = "match",
                  .procedure = "matching",
                  .quantity = "viscosity_pa_s",
                  .repetition = 1,
                  .intensity = set,
                  .reference_intensity = standard,
                  .starting_intensity = start,
                  .response = set});
  }
  /// Adds ten answers at 8 / 1.5 and ten at 8 * 1.5, of which `num_right` are right at either
  /// level.
  void compare_ten(const std::string& block, int num_right) {
    for (int answered = 0; answered < 10; ++answered) {
      compare(block, 8.0 / 1.5, 8.0, answered >= num_right);
      compare(block, 8.0 * 1.5, 8.0, answered < num_right);
    }
  }

  /// Moves the clock on, so that everything that is added afterwards happened later by this
  /// time.
  void wait(double duration_s) { time_ns_ += static_cast<std::int64_t>(1e9 * duration_s); }

 private:
  core::Commit event(const char* kind) {
    core::Commit commit;
    commit.event.session = session_;
    commit.event.sequence = ++sequence_;
    commit.event.time_ns = time_ns_;
    commit.event.kind = kind;
    return commit;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  core::StudyStore store_;
  std::string hash_;
  std::int64_t session_ = 0, trial_ = 0, sequence_ = 0, time_ns_ = 0;
};

}  // namespace jnd::analysis
