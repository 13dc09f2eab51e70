#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>

#include "analysis/found_results.h"
#include "app/interleaved_study.h"
#include "app/session/laboratory_run.h"
#include "app/session/replay_check.h"
#include "app/session/session_setup.h"
#include "app/session_content.h"
#include "core/error.h"
#include "core/storage/integrity.h"
#include "experiments/order/counterbalance.h"
#include "experiments/participants/effects.h"
#include "experiments/participants/median_person.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/study/stage_walk.h"
#include "support/places.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

// Simulates people in blocks whose trials are mixed, with the device in the loop.

namespace jnd::app {
namespace interleaved_run_test {

namespace fs = std::filesystem;

class InterleavedRunTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path folder(const std::string& name) const {
    return temporary_.path() / (name + ".study");
  }
  [[nodiscard]] std::unique_ptr<core::StudyStore> store_with(
      const std::string& name, const std::vector<std::string>& who = {"P01"}) {
    auto store = std::make_unique<core::StudyStore>(
        folder(name), core::StudyStore::Mode::kCreate, core::Durability::kAtClose);
    (void)add_sessions(*store,
                       {.study = study_,
                        .laboratory = &laboratory_,
                        .study_file = "study.json",
                        .seed = 5,
                        .record = false},
                       who);
    return store;
  }
  LaboratoryRun run_of(core::StudyStore& store, std::int64_t session = 1) {
    return {.study = study_,
            .laboratory = laboratory_,
            .store = store,
            .session = session,
            .durability = core::Durability::kAtClose};
  }
  /// Dies as by `kill -9` after this many more events.
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
  static std::vector<std::int64_t> turns_of(const core::StudyStore& store) {
    std::vector<std::int64_t> turns;
    for (const core::EventRow& row : store.events(1)) {
      if (row.kind == "turn_taken") turns.push_back(row.stage.value());
    }
    return turns;
  }
  /// Returns the trials with their stimuli, in the order in which they were answered.
  static std::string order_of(const core::StudyStore& store) {
    std::map<std::int64_t, std::string> order;
    for (const core::TrialRow& row : store.trials(1)) {
      order[row.sequence] = row.block + " " + std::to_string(row.trial) + " " +
                            std::to_string(row.intensity.value_or(0.0));
    }
    std::string text;
    for (const auto& [sequence, words] : order) text += words + "\n";
    return text;
  }
  static std::string problems_of(const core::StudyStore& store) {
    core::Integrity integrity = core::verify(store);
    check_replay(store, integrity);
    std::string words;
    for (const auto& problem : integrity.problems) words += problem.message + "\n";
    return words;
  }

  /// Simulates sessions of the shipped study, by people whose fractions in each block are
  /// multiplied by these factors, on a device without damping of its own.
  analysis::StudyResults results_with(const std::string& name,
                                      const std::vector<std::string>& effects) {
    study_ = experiments::read_study(test_support::source_folder() / "protocols" /
                                     "viscosity_interleaved.json");
    laboratory_ = experiments::parse_laboratory(
        experiments::with_effects(experiments::thesis_laboratory().text, effects), "effects");
    laboratory_.device.mechanical_viscosity_n_s_per_m = 0.0;
    laboratory_.perceiver.weber_fraction = 0.2;
    std::vector<std::string> people;
    for (int i = 1; i <= kPeople; ++i) {
      people.push_back((i < 10 ? "P0" : "P") + std::to_string(i));
    }
    const auto store = store_with(name, people);
    for (std::int64_t session = 1; session <= kPeople; ++session) {
      (void)run_laboratory(run_of(*store, session));
    }
    EXPECT_EQ(problems_of(*store), "");
    return analysis::results_of(analysis::load_study(*store), {}, {.num_resamples = 20});
  }
  static const analysis::ContrastTest& contrast(const analysis::StudyResults& results,
                                                const std::string& name) {
    for (const analysis::ContrastResult& one : results.contrasts) {
      if (one.plan.name == name) return one.test;
    }
    throw core::Error("no contrast " + name);
  }
  /// Returns the value of the simulated median person in this block.
  [[nodiscard]] double put_in(const std::string& name) const {
    double fraction = 0.0;
    for_each_stage(study_.stages, [&](const experiments::Stage& stage) {
      if (stage.name == name) {
        fraction =
            experiments::median_weber_fraction(laboratory_, experiments::block_of(stage, 0));
      }
    });
    return fraction;
  }

  static constexpr int kPeople = 12;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  experiments::Study study_ = experiments::read_study_text(kInterleavedStudy, "study.json");
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
};

TEST_F(InterleavedRunTest, KilledAfterAnyEventItComesToTheOrderOfAnUninterruptedOne) {
  const auto whole = store_with("whole");
  (void)run_laboratory(run_of(*whole));
  EXPECT_EQ(problems_of(*whole), "");
  ASSERT_EQ(whole->trials(1).size(), 2U + 3U + 2U + 4U);
  const std::vector<std::int64_t> turns = turns_of(*whole);
  ASSERT_EQ(turns.size(), 2U + 3U + 4U);
  const std::string order = order_of(*whole);
  const auto num_events = static_cast<std::int64_t>(whole->events(1).size());
  int num_between = 0;
  constexpr std::int64_t kStride = test_support::kIsSanitized ? 7 : 1;
  for (std::int64_t killed_after = 1; killed_after < num_events; killed_after += kStride) {
    const std::string name = "killed" + std::to_string(killed_after);
    store_with(name).reset();
    ASSERT_TRUE(run_and_die(name, killed_after));
    core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                           core::Durability::kAtClose);
    const std::vector<core::TrialRow> answered = store.trials(1);
    const std::string last = store.events(1).back().kind;
    num_between += last == "trial_answered" || last == "trials_drawn" ||
                           last == "question_answered" || last == "stage_entered"
                       ? 1
                       : 0;
    EXPECT_TRUE(run_laboratory(run_of(store)).ended) << killed_after;
    EXPECT_EQ(turns_of(store), turns) << killed_after;
    // A trial that was cut off is felt again and may get another answer, after which the
    // staircase goes another way. Everything before that is the same.
    const std::vector<core::TrialRow> trials = store.trials(1);
    bool felt_again = false;
    for (const core::TrialRow& trial : trials) felt_again = felt_again || trial.attempt > 1;
    if (!felt_again) {
      EXPECT_EQ(difference(order_of(store), order), "") << killed_after;
    }
    ASSERT_EQ(trials.size(), whole->trials(1).size());
    for (const core::TrialRow& before : answered) {
      const auto now = std::ranges::find(trials, before.trial, &core::TrialRow::trial);
      ASSERT_NE(now, trials.end());
      EXPECT_EQ(now->sequence, before.sequence) << killed_after;
    }
    EXPECT_EQ(problems_of(store), "") << killed_after;
    fs::remove_all(folder(name));
  }
  if (kStride == 1) {
    EXPECT_GE(num_between, 15) << "the moments that this is about";
  }
}

TEST_F(InterleavedRunTest, ThreeFractionsThatArePutInComeOut) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const analysis::StudyResults results = results_with(
      "with",
      {"block=middle:weber_fraction_factor=1.6", "block=thin:weber_fraction_factor=2.5"});
  std::map<std::string, double> fractions;
  for (const char* block : {"thin", "middle", "thick"}) {
    const analysis::Estimate* const found =
        results.find(std::string(block) + ".weber_fraction_median_person");
    ASSERT_NE(found, nullptr) << block;
    EXPECT_LT(found->ci95.low.value(), put_in(block)) << block;
    EXPECT_GT(found->ci95.high.value(), put_in(block)) << block;
    fractions[block] = found->value.value();
  }
  EXPECT_GT(fractions["thin"], fractions["middle"]);
  EXPECT_GT(fractions["middle"], fractions["thick"]);
  const analysis::ContrastTest& thin = contrast(results, "thin_against_thick");
  EXPECT_LT(thin.p_value.value(), 0.001);
  EXPECT_GT(thin.ci95.low.value(), 1.0);
}

TEST_F(InterleavedRunTest, NoDifferenceIsToldWhereNoneIsPutIn) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const analysis::StudyResults results = results_with("without", {});
  for (const char* name : {"thin_against_thick", "middle_against_the_others"}) {
    const analysis::ContrastTest& none = contrast(results, name);
    // In one of twenty studies the interval misses 1 although there is no difference. The
    // difference of the test above gives p < 0.001.
    EXPECT_GT(none.p_value.value(), 0.005) << name;
    EXPECT_LT(none.ci95.low.value(), 1.1) << name;
    EXPECT_GT(none.ci95.high.value(), 0.9) << name;
  }
}

}  // namespace interleaved_run_test
}  // namespace jnd::app
