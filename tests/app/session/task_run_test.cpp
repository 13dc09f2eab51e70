#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"
#include "app/session/laboratory_run.h"
#include "app/session/replay_check.h"
#include "app/session/session_setup.h"
#include "app/task_study.h"
#include "core/storage/integrity.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/event.h"
#include "experiments/session/session.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace task_run_test {

/// Simulates a session with several tasks, with the device in the loop.
class TaskRunTest : public ::testing::Test {
 protected:
  void simulate() {
    (void)add_sessions(store_,
                       {.study = study_,
                        .laboratory = &laboratory_,
                        .study_file = "tasks.json",
                        .seed = 5,
                        .record = false},
                       {"P01"});
    const LaboratoryRunResult result =
        run_laboratory({.study = study_,
                        .laboratory = laboratory_,
                        .store = store_,
                        .session = 1,
                        .durability = core::Durability::kAtClose});
    EXPECT_TRUE(result.ended);
  }

  experiments::Study study_ = experiments::read_study_text(kTaskStudy, "tasks.json");
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  core::StudyStore store_{temporary_.path() / "a.study", core::StudyStore::Mode::kCreate,
                          core::Durability::kAtClose};
};

TEST_F(TaskRunTest, EveryTaskRunsToItsEndAndIsWhatItsLogSays) {
  simulate();
  EXPECT_TRUE(store_.completed(1));
  core::Integrity integrity = core::verify(store_);
  check_replay(store_, integrity);
  EXPECT_TRUE(integrity.complete)
      << (integrity.problems.empty() ? "" : integrity.problems.front().message);
  std::map<std::string, int> trials, catches;
  for (const core::TrialRow& row : store_.trials(1)) {
    ++trials[row.block];
    catches[row.block] += row.is_catch ? 1 : 0;
    EXPECT_TRUE(row.response == 0.0 || row.response == 1.0);
    const bool is_drawn = row.block == "which" || row.block == "same" || row.block == "stairs";
    EXPECT_EQ(row.test_interval.has_value(), is_drawn) << row.block;
  }
  EXPECT_EQ(trials["which"], 6);
  EXPECT_EQ(catches["which"], 2);
  EXPECT_EQ(trials["same"], 8);
  EXPECT_EQ(catches["same"], 4);
  EXPECT_EQ(trials["there"], 6);
  EXPECT_EQ(catches["there"], 2);
  EXPECT_GE(trials["practice"], 4);
}

TEST_F(TaskRunTest, PresentationsComeInTheOrderThatWasDrawn) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate();
  std::map<std::int64_t, core::TrialRow> trials;
  for (const core::TrialRow& row : store_.trials(1)) trials[row.trial] = row;
  for (const core::PresentationRow& row : store_.presentations(1)) {
    const core::TrialRow& trial = trials.at(row.trial);
    if (!trial.test_interval) continue;
    const bool is_first = row.presentation % 2 == 1;
    EXPECT_EQ(row.interval, is_first == (trial.test_interval == 1) ? "test" : "reference");
  }
}

TEST_F(TaskRunTest, TheSamePersonAnswersNearlyTheSameWithoutADevice) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate();
  const experiments::AnswerSimulator simulator(study_, laboratory_);
  const core::SessionRow session = store_.session(1);
  std::map<std::string, std::vector<double>> simulated;
  for (const core::TrialRow& row : store_.trials(1)) {
    simulated[row.block].push_back(row.response.value());
  }
  for (const experiments::AnsweredBlock& block :
       simulator.answers(experiments::stages_of(study_, {}), session.seed)) {
    const std::vector<double>& other = simulated[block.stage->name];
    if (std::holds_alternative<experiments::Block>(block.stage->content) &&
        block.stage->name == "stairs") {
      continue;  // One different answer leads to another staircase.
    }
    ASSERT_EQ(block.trials.size(), other.size()) << block.stage->name;
    int differ = 0;
    for (std::size_t i = 0; i < other.size(); ++i) {
      differ += block.trials[i].response != other[i] ? 1 : 0;
    }
    EXPECT_LE(differ, 1) << block.stage->name;
  }
}

TEST_F(TaskRunTest, TheLogTellsWhatFeedbackWasGiven) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate();
  int told = 0;
  for (const core::EventRow& row : store_.events(1)) {
    if (row.kind != "trial_answered") continue;
    const auto event = experiments::event_from_row(row);
    const auto& answer = std::get<experiments::TrialAnswered>(event.data);
    if (!answer.feedback_right) continue;
    ++told;
    for (const core::TrialRow& trial : store_.trials(1)) {
      if (trial.trial != answer.trial) continue;
      EXPECT_EQ(trial.block, "practice");
      const double right = *trial.intensity > *trial.reference_intensity ? 1.0 : 0.0;
      EXPECT_EQ(*answer.feedback_right, trial.response == right);
    }
  }
  EXPECT_GE(told, 4);
}

TEST_F(TaskRunTest, AnalysesGetNeitherPracticeNorCatchTrials) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate();
  const analysis::StudyData data = analysis::load_study(store_);
  std::map<std::string, analysis::BlockDesign> blocks;
  for (const analysis::BlockDesign& block : data.blocks) blocks[block.block] = block;
  EXPECT_FALSE(blocks.contains("practice"));
  EXPECT_EQ(blocks.size(), 4U);
  EXPECT_TRUE(blocks["which"].compares());
  EXPECT_TRUE(blocks["stairs"].compares());
  EXPECT_FALSE(blocks["same"].compares());
  EXPECT_FALSE(blocks["there"].compares());
  const analysis::ParticipantData& person = data.participants.front();
  EXPECT_EQ(person.trials_in("which").size(), 4U);
  EXPECT_EQ(person.trials_in("same").size(), 4U);
  EXPECT_TRUE(person.trials_in("practice").empty());
  EXPECT_FALSE(person.presentations.contains("practice"));
  EXPECT_FALSE(person.presentations.contains(""));
  int num_catch = 0;
  for (const core::TrialRow& trial : person.catch_trials) {
    EXPECT_TRUE(trial.is_catch);
    num_catch += trial.block == "same" ? 1 : 0;
  }
  EXPECT_EQ(num_catch, 4);
  // The results say beside the data that there was practice, and how well it went.
  ASSERT_EQ(data.practice.size(), 1U);
  const analysis::PracticeRun& practice = data.practice.front();
  EXPECT_EQ(practice.block, "practice");
  EXPECT_EQ(practice.num_trials, std::ssize(person.practice_trials));
  EXPECT_EQ(practice.problem, "");
  constexpr int kJudged = 4;  // The study judges this many answers, of which 3 must be right.
  std::vector<bool> right;
  for (const core::TrialRow& trial : person.practice_trials) {
    right.push_back((*trial.intensity > *trial.reference_intensity) == (trial.response == 1.0));
  }
  ASSERT_GE(right.size(), 4U);
  const auto num_right = std::count(right.end() - kJudged, right.end(), true);
  const analysis::StudyResults results = analysis::results_of(data, {}, {.num_resamples = 50});
  const auto section =
      std::ranges::find(results.sections, "practice", &analysis::ResultsSection::name);
  ASSERT_NE(section, results.sections.end());
  std::map<std::string, std::optional<double>> told;
  for (const analysis::ParticipantEstimate& own : section->participants) {
    EXPECT_EQ(own.participant, "P01");
    EXPECT_EQ(own.reason, "") << own.name << ": reasons are of values that are not there";
    told[own.name] = own.value;
  }
  EXPECT_EQ(told["practice.num_trials"], static_cast<double>(right.size()));
  EXPECT_EQ(told["practice.num_judged"], kJudged);
  EXPECT_EQ(told["practice.num_correct"], static_cast<double>(num_right));
  EXPECT_EQ(told["practice.criterion_met"], num_right >= 3 ? 1.0 : 0.0);
}

TEST_F(TaskRunTest, PracticeOfEverySessionIsKeptAlsoWhereItWasBrokenOff) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate();
  (void)add_sessions(store_,
                     {.study = study_,
                      .laboratory = &laboratory_,
                      .study_file = "tasks.json",
                      .seed = 6,
                      .record = false},
                     {"P02"});
  int num_answers = 0;
  LaboratoryRun plan{.study = study_,
                     .laboratory = laboratory_,
                     .store = store_,
                     .session = 2,
                     .durability = core::Durability::kAtClose};
  plan.on_event = [&](const core::EventRow& event) {
    num_answers += event.kind == "trial_answered" ? 1 : 0;
  };
  plan.is_cancelled = [&] { return num_answers == 2; };
  EXPECT_FALSE(run_laboratory(plan).ended);
  const analysis::StudyData data = analysis::load_study(store_);
  ASSERT_EQ(data.practice.size(), 2U);
  EXPECT_EQ(data.practice[0].problem, "");
  EXPECT_EQ(data.practice[1].participant, "P02");
  EXPECT_EQ(data.practice[1].num_trials, 2);
  EXPECT_EQ(data.practice[1].num_judged, 2) << "of the four that the criterion is of";
  EXPECT_FALSE(data.practice[1].criterion_met);
}

}  // namespace task_run_test
}  // namespace jnd::app
