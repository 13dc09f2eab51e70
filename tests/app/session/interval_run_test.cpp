#include <gtest/gtest.h>

#include "analysis/found_results.h"
#include "app/session/laboratory_run.h"
#include "app/session/session_setup.h"
#include "core/storage/integrity.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/places.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

// Simulates people who choose among intervals, and analyses their choices.

namespace jnd::app {
namespace interval_run_test {

class IntervalRunTest : public ::testing::Test {
 protected:
  /// Simulates one session for each of `num_people` people of `laboratory_`.
  analysis::StudyResults results(const std::string& name, int num_people) {
    std::vector<std::string> people;
    for (int i = 1; i <= num_people; ++i) people.push_back("P0" + std::to_string(i));
    core::StudyStore store(temporary_.path() / (name + ".study"),
                           core::StudyStore::Mode::kCreate, core::Durability::kAtClose);
    const std::vector<std::int64_t> sessions = add_sessions(store,
                                                            {.study = study_,
                                                             .laboratory = &laboratory_,
                                                             .study_file = "study.json",
                                                             .seed = 11,
                                                             .record = false},
                                                            people);
    for (const std::int64_t session : sessions) {
      (void)run_laboratory({.study = study_,
                            .laboratory = laboratory_,
                            .store = store,
                            .session = session,
                            .durability = core::Durability::kAtClose});
    }
    EXPECT_TRUE(core::verify(store).complete);
    return analysis::results_of(analysis::load_study(store), {}, {.num_resamples = 20});
  }
  static const analysis::Comparison& against_guessing(const analysis::StudyResults& results,
                                                      const std::string& block) {
    for (const analysis::NamedComparison& one :
         analysis::section_of(results, block).comparisons) {
      if (one.name.starts_with(block + ": right answers")) return one.comparison;
    }
    throw core::Error("no comparison of " + block);
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  experiments::Study study_ = experiments::read_study(test_support::source_folder() /
                                                      "protocols" / "viscosity_oddity.json");
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
};

TEST_F(IntervalRunTest, AbilityIsFoundInBothTasksAndNoneInPeopleWhoGuess) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const analysis::StudyResults able = results("able", 5);
  const analysis::Comparison& odd = against_guessing(able, "odd_one");
  EXPECT_GT(odd.ci95.low.value(), 0.1);
  EXPECT_LT(odd.p_value.value(), 0.001);
  // A person who does both tasks needs a larger difference to find the odd one.
  const double two = able.find("thicker.weber_fraction_median_person")->value.value();
  const double three = able.find("odd_one.weber_fraction")->value.value();
  EXPECT_GT(three, two);
  EXPECT_LT(two, 1.0);

  laboratory_.perceiver.weber_fraction = 1e6;
  const analysis::StudyResults guessing = results("guessing", 3);
  const analysis::Comparison& none = against_guessing(guessing, "odd_one");
  EXPECT_LT(none.ci95.low.value(), 0.0);
  EXPECT_GT(none.ci95.high.value(), 0.0);
}

TEST_F(IntervalRunTest, WithoutADeviceTheSamePeopleChooseTheSame) {
  const experiments::AnswerSimulator simulator(study_, laboratory_);
  const experiments::Cell cell = experiments::cells_of(study_).front();
  const auto blocks = simulator.answers(stages_of(study_, cell), 99);
  ASSERT_EQ(blocks.size(), 2U);
  int num_right = 0, num_trials = 0;
  for (const experiments::AnsweredTrial& trial : blocks.back().trials) {
    ASSERT_EQ(trial.planned.intervals.size(), blocks.back().stage->name == "odd_one" ? 3U : 0U);
    num_right += trial.response == 1.0 ? 1 : 0;
    ++num_trials;
  }
  EXPECT_GT(num_right, num_trials / 2) << "1 up and 2 down aim at 70.7 %";
}

}  // namespace interval_run_test
}  // namespace jnd::app
