#include "app/session/replay_check.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "app/session/missing_force.h"
#include "core/error.h"
#include "core/storage/stream_file.h"
#include "experiments/session/session_state.h"

namespace jnd::app {
namespace {

using experiments::SessionState;
using experiments::TrialState;

class ReplayCheck {
 public:
  ReplayCheck(const core::StudyStore& store, std::int64_t session, core::Integrity& integrity)
      : store_(store), session_(session), integrity_(integrity) {}

  void run() {
    for (const core::EventRow& row : store_.events(session_)) {
      const experiments::Event event = experiments::event_from_row(row);
      check_stream(event);
      apply(state_, event);
    }
    check_design();
    check_trials();
    check_presentations();
    check_questions();
    if (state_.num_without_force > 0) {
      integrity_.remarks.push_back(
          {session_, "CAUTION, " + missing_force_words(state_.num_without_force,
                                                       state_.missing_force_cause)});
    }
  }

 private:
  void problem(std::int64_t trial, const std::string& what) {
    integrity_.problems.push_back(
        {session_, "trial " + std::to_string(trial) + ": expected its " + what +
                       " as the log of events has it, found another; one of them is damaged"});
  }
  [[nodiscard]] const TrialState* of(std::int64_t trial, const std::string& what) {
    const auto num_trials = static_cast<std::int64_t>(state_.trials.size());
    if (trial >= 1 && trial <= num_trials) return &state_.trial(trial);
    problem(trial, what);
    return nullptr;
  }

  /// Checks that the file named by an event exists, and that it is the one that the event
  /// describes.
  void check_stream(const experiments::Event& event) {
    const auto* opened = std::get_if<experiments::StreamOpened>(&event.data);
    const auto* closed = std::get_if<experiments::StreamClosed>(&event.data);
    const std::string file = opened != nullptr   ? opened->file
                             : closed != nullptr ? closed->file
                                                 : "";
    if (file.empty()) return;
    const std::filesystem::path path =
        store_.recording_file(session_).parent_path() / std::filesystem::path(file).filename();
    if (!std::filesystem::exists(path)) {
      // The event that opened it has already told this.
      if (opened == nullptr) return;
      integrity_.problems.push_back(
          {session_, file + ": expected a stream that was recorded, found no such file"});
      return;
    }
    if (closed == nullptr) return;
    const core::StreamFileSeal told{closed->num_samples, closed->num_offsets, closed->sha256};
    try {
      if (core::StreamFileReader(path).seal() == told) return;
    } catch (const core::Error&) {
      // A damaged file is reported where its content is checked.
      return;
    }
    integrity_.problems.push_back(
        {session_, file + ": expected the stream as the log of events has it, found another; "
                          "one of them is damaged"});
  }

  void check_design() {
    std::set<std::int64_t> in_force;
    for (const core::DesignRow& row : store_.design(session_)) in_force.insert(row.trial);
    const std::vector<core::DesignRow> design =
        store_.design(session_, /*include_voided=*/true);
    if (design.size() != state_.trials.size()) problem(0, "drawn trials");
    for (const core::DesignRow& row : design) {
      const TrialState* trial = of(row.trial, "design");
      if (trial == nullptr) continue;
      const bool same = row.stage == trial->stage &&
                        core::has_same_columns(trial->planned, row) &&
                        row.sequence.value_or(trial->drawn_sequence) == trial->drawn_sequence &&
                        in_force.contains(row.trial) != trial->is_void;
      if (!same) problem(row.trial, "design");
    }
  }

  void check_trials() {
    std::set<std::int64_t> excluded;
    for (std::size_t i = 0; i < state_.trials.size(); ++i) {
      if (state_.trials[i].excluded) excluded.insert(static_cast<std::int64_t>(i) + 1);
    }
    std::set<std::int64_t> in_force;
    for (const core::TrialRow& row : store_.trials(session_)) in_force.insert(row.trial);
    std::set<std::int64_t> answered;
    for (const core::TrialRow& row : store_.trials(session_, /*include_excluded=*/true)) {
      answered.insert(row.trial);
      const TrialState* trial = of(row.trial, "answer");
      if (trial == nullptr) continue;
      if (row.response != trial->response || row.attempt != trial->attempt) {
        problem(row.trial, "answer");
      }
      if (excluded.contains(row.trial) == in_force.contains(row.trial)) {
        problem(row.trial, "exclusion");
      }
    }
    for (std::size_t i = 0; i < state_.trials.size(); ++i) {
      const auto number = static_cast<std::int64_t>(i) + 1;
      if (state_.trials[i].is_answered != answered.contains(number)) {
        problem(number, "answer");
      }
    }
  }

  void check_presentations() {
    for (const core::PresentationRow& row : store_.presentations(session_)) {
      const TrialState* trial = of(row.trial, "presentation");
      if (trial == nullptr) continue;
      const auto index = static_cast<std::size_t>(row.presentation) - 1;
      if (index >= trial->presentations.size()) {
        problem(row.trial, "presentation");
        continue;
      }
      const experiments::PresentationState& presented = trial->presentations[index];
      if (row.interval != presented.interval || row.intensity != presented.intensity ||
          row.first_tick != presented.first_tick || row.last_tick != presented.last_tick) {
        problem(row.trial, "presentation");
      }
    }
  }

  void check_questions() {
    std::map<std::int64_t, std::map<std::string, std::string>> rows;
    for (const core::QuestionAnswerRow& row :
         store_.question_answers(session_, /*include_excluded=*/true)) {
      rows[row.trial][row.question] = row.answer;
    }
    for (std::size_t i = 0; i < state_.trials.size(); ++i) {
      const auto number = static_cast<std::int64_t>(i) + 1;
      if (rows[number] != state_.trials[i].question_answers) problem(number, "questions");
    }
  }

  const core::StudyStore& store_;
  std::int64_t session_;
  core::Integrity& integrity_;
  SessionState state_;
};

}  // namespace

void check_replay(const core::StudyStore& store, core::Integrity& integrity,
                  const core::Progress& progress) {
  const std::vector<core::SessionRow> sessions = store.sessions();
  std::size_t num_done = 0;
  for (const core::SessionRow& row : sessions) {
    core::tell(progress, num_done++, sessions.size());
    try {
      ReplayCheck(store, row.session, integrity).run();
    } catch (const core::Error& error) {
      integrity.problems.push_back({row.session, error.what()});
    }
  }
  integrity.complete = integrity.problems.empty();
}

}  // namespace jnd::app
