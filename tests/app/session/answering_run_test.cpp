#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>

#include "analysis/found_results.h"
#include "app/answering_study.h"
#include "app/session/laboratory_run.h"
#include "app/session/replay_check.h"
#include "app/session/session_setup.h"
#include "core/storage/integrity.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/event.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

// Simulates people who miss deadlines or cannot tell, and stimuli with times, with the device
// in the loop.

namespace jnd::app {
namespace answering_run_test {

namespace fs = std::filesystem;

class AnsweringRunTest : public ::testing::Test {
 protected:
  AnsweringRunTest() { laboratory_.perceiver.look_again_probability = 0.5; }

  experiments::Block& block(std::size_t stage) {
    return std::get<experiments::Block>(study_.stages.at(stage).content);
  }
  [[nodiscard]] fs::path folder(const std::string& name) const {
    return temporary_.path() / (name + ".study");
  }
  [[nodiscard]] std::unique_ptr<core::StudyStore> store_with(const std::string& name) {
    auto store = std::make_unique<core::StudyStore>(
        folder(name), core::StudyStore::Mode::kCreate, core::Durability::kAtClose);
    (void)add_sessions(*store,
                       {.study = study_,
                        .laboratory = &laboratory_,
                        .study_file = "study.json",
                        .seed = 5,
                        .record = false},
                       {"P01"});
    return store;
  }
  LaboratoryRun run_of(core::StudyStore& store) {
    return {.study = study_,
            .laboratory = laboratory_,
            .store = store,
            .session = 1,
            .durability = core::Durability::kAtClose};
  }
  std::unique_ptr<core::StudyStore> simulated(const std::string& name) {
    auto store = store_with(name);
    EXPECT_TRUE(run_laboratory(run_of(*store)).ended);
    return store;
  }
  /// Dies as by `kill -9` after `num_events` more events.
  bool run_and_die(const std::string& name, std::int64_t num_events) {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                               core::Durability::kAtClose);
        LaboratoryRun plan = run_of(store);
        plan.on_event = [&](const core::EventRow&) {
          if (--num_events == 0) ::_exit(9);
        };
        (void)run_laboratory(plan);
      } catch (...) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WEXITSTATUS(status) == 9;
  }
  /// A presentation of any attempt, and how long it lasted.
  struct Felt {
    std::int64_t trial = 0, attempt = 0;
    std::string interval;
    double duration_s = 0.0;
  };
  static std::vector<Felt> felt(const core::StudyStore& store) {
    std::vector<Felt> all;
    std::int64_t first_tick = 0;
    for (const core::EventRow& row : store.events(1)) {
      const experiments::Event event = experiments::event_from_row(row);
      if (const auto* began = std::get_if<experiments::PresentationStarted>(&event.data)) {
        all.push_back({began->trial, began->attempt, began->interval});
        first_tick = began->first_tick;
      }
      if (const auto* ended = std::get_if<experiments::PresentationEnded>(&event.data)) {
        all.back().duration_s = 1e-3 * static_cast<double>(ended->last_tick - first_tick + 1);
      }
    }
    return all;
  }
  static std::vector<experiments::AttemptDiscarded> missed(const core::StudyStore& store) {
    std::vector<experiments::AttemptDiscarded> all;
    for (const core::EventRow& row : store.events(1)) {
      const experiments::Event event = experiments::event_from_row(row);
      const auto* one = std::get_if<experiments::AttemptDiscarded>(&event.data);
      if (one != nullptr && one->missed_deadline) all.push_back(*one);
    }
    return all;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  experiments::Study study_ = experiments::read_study_text(kAnsweringStudy, "study.json");
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
};

TEST_F(AnsweringRunTest, WhoLooksAgainMissesTheDeadlineAndEveryTrialIsAnsweredInTheEnd) {
  const auto store = simulated("a");
  const auto late = missed(*store);
  ASSERT_FALSE(late.empty());
  const std::vector<core::TrialRow> trials = store->trials(1);
  EXPECT_EQ(std::ranges::count(trials, "open", &core::TrialRow::block), 6);
  for (const experiments::AttemptDiscarded& one : late) {
    EXPECT_EQ(one.reason, "no answer within the deadline of 3 s");
    const auto answered = std::ranges::find(trials, one.trial, &core::TrialRow::trial);
    ASSERT_NE(answered, trials.end());
    EXPECT_GT(answered->attempt, one.attempt);
  }
  core::Integrity integrity = core::verify(*store);
  check_replay(*store, integrity);
  EXPECT_TRUE(integrity.complete)
      << (integrity.problems.empty() ? "" : integrity.problems.front().message);
}

TEST_F(AnsweringRunTest, NothingIsFeltAfterTheDeadline) {
  const auto store = simulated("a");
  std::map<std::pair<std::int64_t, std::int64_t>, double> since_asked_s;
  for (const Felt& one : felt(*store)) {
    if (one.trial > 6) continue;
    double& since_s = since_asked_s[{one.trial, one.attempt}];
    if (one.interval == "test" || since_s > 0.0) since_s += one.duration_s;
  }
  double longest_s = 0.0;
  for (const auto& [attempt, since_s] : since_asked_s) longest_s = std::max(longest_s, since_s);
  EXPECT_LE(longest_s, 3.0 + 1e-9);
  EXPECT_GT(longest_s, 2.9) << "some came to it";
}

TEST_F(AnsweringRunTest, AStimulusIsFeltNoShorterAndNoLongerThanTheBlockSays) {
  block(0).answer_deadline_s.reset();
  for (const auto& [min_s, max_s] :
       {std::pair{0.0, 0.4}, {6.0, 8.0}, {1.25, 1.25}, {0.3337, 0.3337}}) {
    block(0).min_stimulus_s = min_s;
    block(0).max_stimulus_s = max_s;
    const auto store = simulated(std::to_string(min_s) + "_" + std::to_string(max_s));
    for (const Felt& one : felt(*store)) {
      if (one.trial > 6) continue;
      EXPECT_GE(one.duration_s, min_s - 0.0006) << "to the nearest tick";
      EXPECT_LE(one.duration_s, max_s + 0.0006);
    }
    // Each presentation, however short, says what was delivered.
    for (const core::PresentationRow& row : store->presentations(1)) {
      EXPECT_GT(row.measures.delivered_damping_n_s_per_m.value(), 0.0);
    }
  }
}

TEST_F(AnsweringRunTest, WithoutReturnsEachIntervalIsFeltOnce) {
  const auto store = simulated("a");
  for (const core::TrialRow& row : store->trials(1)) {
    if (row.block != "stairs") continue;
    EXPECT_EQ(row.num_presentations, 2) << row.trial;
  }
}

TEST_F(AnsweringRunTest, WhoCannotTellSaysSoAndTheRestIsAnsweredAsWithoutIt) {
  laboratory_.perceiver.cannot_tell_certainty = 0.6;
  const auto store = simulated("open");
  block(0).cannot_tell = false;
  const auto forced = simulated("forced");
  int num_open = 0, num_told = 0;
  const std::vector<core::TrialRow> told = store->trials(1), chosen = forced->trials(1);
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_EQ(told[i].trial, chosen[i].trial);
    num_open += told[i].response ? 0 : 1;
    if (!told[i].response) continue;
    ++num_told;
    EXPECT_EQ(told[i].response, chosen[i].response);
  }
  EXPECT_GT(num_open, 0);
  EXPECT_GT(num_told, 0);
}

TEST_F(AnsweringRunTest, WhoWasTooLateHurriesAndIsInTimeWhenTheTrialComesAgain) {
  block(0).answer_deadline_s = 0.2;
  block(0).min_stimulus_s = 0.0;
  const auto store = simulated("a");
  EXPECT_EQ(missed(*store).size(), 6U) << "each once";
  for (const core::TrialRow& row : store->trials(1)) {
    if (row.block != "open") continue;
    EXPECT_EQ(row.attempt, 2);
    EXPECT_LT(row.measures.response_time_s.value(), 0.2);
    EXPECT_GT(row.measures.response_time_s.value(), 0.19);
  }
}

TEST_F(AnsweringRunTest, AnAdjustmentEndsAtItsDeadlineToo) {
  study_ = experiments::read_study_text(R"json({"format": 1, "name": "adjust",
    "languages": ["en"], "title": {"en": "A"}, "authors": ["A. Author"],
    "device": {"min_contact_points": 1},
    "stages": [{"kind": "block", "name": "set", "procedure": "matching", "medium": "viscous",
      "viscosity_pa_s": [20], "standard_medium": "viscous", "standard_viscosity_pa_s": [2],
      "repetitions": 2, "coarse_step_viscosity_pa_s": 1, "fine_step_viscosity_pa_s": 0.5,
      "max_stimulus_s": 2, "answer_deadline_s": 9, "instruction": {"en": "Adjust."},
      "question": {"en": "So?"}, "expected_trial_s": 10}]})json",
                                        "study.json");
  const auto store = simulated("a");
  EXPECT_EQ(missed(*store).size(), 2U);
  for (const core::TrialRow& row : store->trials(1)) {
    EXPECT_EQ(row.attempt, 2);
    EXPECT_GT(row.num_steps, 1);
  }
  core::Integrity integrity = core::verify(*store);
  EXPECT_TRUE(integrity.complete);
}

TEST_F(AnsweringRunTest, KilledAfterAnyEventNothingThatWasAnsweredIsLost) {
  const auto whole = simulated("whole");
  const auto num_events = static_cast<std::int64_t>(whole->events(1).size());
  ASSERT_FALSE(missed(*whole).empty());
  constexpr std::int64_t kStride = test_support::kIsSanitized ? 7 : 2;
  int num_after_a_miss = 0;
  for (std::int64_t killed_after = 1; killed_after < num_events; killed_after += kStride) {
    const std::string name = "killed" + std::to_string(killed_after);
    store_with(name).reset();
    ASSERT_TRUE(run_and_die(name, killed_after));
    core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                           core::Durability::kAtClose);
    const std::vector<core::TrialRow> answered = store.trials(1);
    const std::size_t num_missed = missed(store).size();
    num_after_a_miss += store.events(1).back().kind == "attempt_discarded" ? 1 : 0;
    EXPECT_TRUE(run_laboratory(run_of(store)).ended) << killed_after;
    const std::vector<core::TrialRow> trials = store.trials(1);
    for (std::size_t i = 0; i < answered.size(); ++i) {
      const auto found = std::ranges::find(trials, answered[i].trial, &core::TrialRow::trial);
      ASSERT_NE(found, trials.end()) << killed_after;
      EXPECT_EQ(found->sequence, answered[i].sequence) << killed_after;
      EXPECT_EQ(found->response, answered[i].response) << killed_after;
    }
    EXPECT_GE(missed(store).size(), num_missed) << killed_after;
    core::Integrity integrity = core::verify(store);
    check_replay(store, integrity);
    EXPECT_TRUE(integrity.complete) << killed_after;
    fs::remove_all(folder(name));
  }
  if (kStride == 2) {
    EXPECT_GT(num_after_a_miss, 0) << "the moments that this is about";
  }
}

TEST_F(AnsweringRunTest, ResultsCountWhatMissedItsDeadlineAndWhatCouldNotBeTold) {
  laboratory_.perceiver.cannot_tell_certainty = 0.6;
  const auto store = simulated("a");
  const auto results =
      analysis::results_of(analysis::load_study(*store), {}, {.num_resamples = 5});
  const analysis::ResultsSection& section = analysis::section_of(results, "unanswered");
  int num_open = 0;
  for (const core::TrialRow& row : store->trials(1)) num_open += row.response ? 0 : 1;
  EXPECT_GT(num_open, 0);
  EXPECT_EQ(analysis::own_of(section, "P01", "open.num_cannot_tell").value, num_open);
  EXPECT_EQ(analysis::own_of(section, "P01", "open.num_missed_deadline").value,
            static_cast<double>(missed(*store).size()));
}

}  // namespace answering_run_test
}  // namespace jnd::app
