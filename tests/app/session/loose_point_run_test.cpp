#include <gtest/gtest.h>

#include <algorithm>

#include "app/session/laboratory_run.h"
#include "app/session/session_setup.h"
#include "app/tiny_study.h"
#include "core/error.h"
#include "core/storage/integrity.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace loose_point_run_test {

/// Simulates participants whose index finger comes off.
class LoosePointRunTest : public ::testing::Test {
 protected:
  LoosePointRunTest() {
    (void)add_sessions(
        store_,
        {.study = study_, .laboratory = &laboratory_, .study_file = "tiny.json", .seed = 5},
        {"P01"});
  }

  LaboratoryRunResult run(std::int64_t first_tick, std::int64_t num_ticks) {
    return run_laboratory(
        {.study = study_,
         .laboratory = laboratory_,
         .store = store_,
         .session = 1,
         .injected_faults = {{.first_tick = first_tick,
                              .num_ticks = num_ticks,
                              .injection = device::Injection::kDetachedPoint}},
         .durability = core::Durability::kAtClose});
  }
  [[nodiscard]] std::int64_t count(const std::string& kind) const {
    const std::vector<core::EventRow> events = store_.events(1);
    return std::count_if(events.begin(), events.end(),
                         [&](const core::EventRow& event) { return event.kind == kind; });
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  experiments::Study study_ = experiments::read_study_text(
      replaced(kTinyStudy, R"({"medium": "free_space", "duration_s": 0.5})",
               R"({"medium": "free_space", "duration_s": 0.5},
                  {"medium": "free_space", "duration_s": 0.5})"),
      "tiny.json");
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
  core::StudyStore store_{temporary_.path() / "a.study", core::StudyStore::Mode::kCreate,
                          core::Durability::kAtClose};
};

TEST_F(LoosePointRunTest, TheTrialIsRepeatedOnceTheFingerHoldsAgain) {
  EXPECT_TRUE(run(4000, 1500).ended);
  EXPECT_EQ(count("paused"), 1);
  EXPECT_EQ(count("continued"), 1);
  EXPECT_EQ(count("attempt_discarded"), 1);
  EXPECT_EQ(store_.trials(1).size(), std::size_t{kTinyTrials});
  const core::Integrity integrity = core::verify(store_);
  EXPECT_TRUE(integrity.complete);
  EXPECT_TRUE(integrity.problems.empty());
}

TEST_F(LoosePointRunTest, AMediumOutsideOfTrialsIsFeltAgain) {
  // There are two times, of half a second each, and this is the second.
  EXPECT_TRUE(run(800, 700).ended);
  EXPECT_EQ(count("paused"), 1);
  EXPECT_EQ(count("attempt_discarded"), 0);
  EXPECT_EQ(count("medium_explored"), 2);
}

TEST_F(LoosePointRunTest, AFingerThatDoesNotHoldAgainEndsTheRunAndLeavesTheSessionOpen) {
  try {
    (void)run(4000, 1'000'000'000);
    ADD_FAILURE() << "a finger that is off for ever was not noticed";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("the index finger"), std::string::npos);
  }
  EXPECT_FALSE(store_.finished(1));
  EXPECT_EQ(store_.events(1).back().kind, "paused");
}

}  // namespace loose_point_run_test
}  // namespace jnd::app
