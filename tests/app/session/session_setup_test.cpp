#include "app/session/session_setup.h"
#include "app/session/device_checks.h"
#include "app/session/pseudonym.h"
#include "app/session/session_batch.h"
#include "app/session/stored_session.h"

#include <gtest/gtest.h>

#include <mutex>

#include "app/command_line/command.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "core/clock.h"
#include "core/error.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace session_setup_test {

namespace fs = std::filesystem;

class SessionSetupTest : public ::testing::Test {
 protected:
  SessionSetup setup() {
    return {.study = study_, .laboratory = &laboratory_, .study_file = "t.json", .seed = 3};
  }
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  core::StudyStore store_{temporary_.path() / "a.study", core::StudyStore::Mode::kCreate,
                          core::Durability::kAtClose};
  experiments::Study study_ = experiments::read_study_text(kTinyStudy, "t.json");
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
};

TEST(FaultWords, TheSilenceOfADriverComesBeforeWhatTheLoopNoticed) {
  using core::Fault;
  const std::string killed = "its process crashed (Killed)";
  for (const Fault fault :
       {Fault::kStaleSample, Fault::kHostTooSlow, Fault::kDeviceReadFailed}) {
    EXPECT_EQ(fault_words(fault, killed, /*device_answers=*/false),
              std::string(core::words(Fault::kDeviceReadFailed)) +
                  " The driver says: its process crashed (Killed).");
  }
  EXPECT_EQ(fault_words(Fault::kEmergencyStop, killed, false),
            core::words(Fault::kEmergencyStop));
  EXPECT_EQ(fault_words(Fault::kStaleSample, "the cable is out", true),
            core::words(Fault::kStaleSample));
}

TEST_F(SessionSetupTest, EverySessionHasASeedOfItsOwnAndEverythingNeededToRepeatIt) {
  ASSERT_EQ(add_sessions(store_, setup(), {"P01", "P02"}), (std::vector<std::int64_t>{1, 2}));
  const std::vector<core::SessionRow> rows = store_.sessions();
  EXPECT_NE(rows[0].seed, rows[1].seed);
  for (const core::SessionRow& row : rows) {
    EXPECT_TRUE(row.simulated);
    EXPECT_FALSE(row.pilot);
    EXPECT_EQ(row.laboratory, laboratory_.text);
    EXPECT_EQ(store_.protocol(row.protocol_sha256).text, kTinyStudy);
    EXPECT_EQ(row.rate_hz, 1000.0);
    EXPECT_NE(row.program_version, "");
  }
}

TEST_F(SessionSetupTest, ASessionInRealTimeKeepsWhenItBeganAndASimulatedOneCountsFromZero) {
  const std::int64_t before_ns = core::SystemClock().now_ns();
  SessionSetup real = setup();
  real.realtime = true;
  (void)add_sessions(store_, real, {"P01"});
  (void)add_sessions(store_, setup(), {"P02"});
  const std::vector<core::SessionRow> rows = store_.sessions();
  EXPECT_GE(rows.at(0).started_time_ns, before_ns);
  EXPECT_LE(rows.at(0).started_time_ns, core::SystemClock().now_ns());
  EXPECT_EQ(rows.at(1).started_time_ns, 0);
}

TEST_F(SessionSetupTest, AKnownParticipantIsRefusedBeforeAnySessionIsAdded) {
  (void)add_sessions(store_, setup(), {"P02"});
  EXPECT_THROW((void)add_sessions(store_, setup(), {"P01", "P02"}), core::Error);
  EXPECT_EQ(store_.sessions().size(), 1U);
  EXPECT_THROW((void)add_sessions(store_, setup(), {"P03", "P03"}), core::Error);
  EXPECT_EQ(store_.sessions().size(), 1U);
}

TEST_F(SessionSetupTest, ADeviceThatAPersonHasToMoveIsRefusedWithThePlaceOfItsName) {
  EXPECT_NO_THROW(require_device_moves_by_itself("lumped", "session 3"));
  try {
    require_device_moves_by_itself("mouse", "session 3");
    FAIL() << "a simulated participant was given a mouse";
  } catch (const UsageError& error) {
    EXPECT_TRUE(std::string(error.what())
                    .starts_with("session 3: expected a device that moves by itself, "))
        << error.what();
  }
}

TEST_F(SessionSetupTest, PseudonymsFillTheGaps) {
  (void)add_sessions(store_, setup(), {"P02", "somebody"});
  EXPECT_EQ(next_participants(store_, 3), (std::vector<std::string>{"P01", "P03", "P04"}));
  EXPECT_EQ(next_participants(store_, 100).back(), "P101");
}

TEST_F(SessionSetupTest, ASessionKeepsTheStudyAsItWasWhenItBegan) {
  (void)add_sessions(store_, setup(), {"P01"});
  EXPECT_EQ(stored_study(store_, 1).text, kTinyStudy);
  EXPECT_THROW((void)stored_study(store_, 2), core::Error);
}

TEST_F(SessionSetupTest, MoreJobsThanSessionsAreNoHarm) {
  const std::vector<std::int64_t> sessions = add_sessions(store_, setup(), {"P01", "P02"});
  double last = 0.0;
  std::mutex mutex;
  const std::int64_t num_ticks = run_batch({.study = study_,
                                            .laboratory = laboratory_,
                                            .store = store_,
                                            .sessions = sessions,
                                            .jobs = 16,
                                            .on_progress = [&](double done) {
                                              const std::lock_guard guard(mutex);
                                              EXPECT_GE(done, 0.0);
                                              EXPECT_LE(done, 1.0 + 1e-9);
                                              last = done;
                                            }});
  EXPECT_GT(num_ticks, 0);
  EXPECT_GT(last, 0.5);
  EXPECT_TRUE(store_.completed(1));
  EXPECT_TRUE(store_.completed(2));
}

TEST_F(SessionSetupTest, AnErrorOfOneSessionIsThrownOnceTheOthersAreDone) {
  std::vector<std::int64_t> sessions = add_sessions(store_, setup(), {"P01"});
  sessions.push_back(77);
  EXPECT_THROW((void)run_batch({.study = study_,
                                .laboratory = laboratory_,
                                .store = store_,
                                .sessions = sessions,
                                .jobs = 2,
                                .on_progress = {}}),
               core::Error);
}

TEST(RequireDevice, IsWrongUsageForAnUnknownOne) {
  EXPECT_NO_THROW(require_device("lumped"));
  EXPECT_THROW(require_device("unobtainable"), UsageError);
}

}  // namespace session_setup_test
}  // namespace jnd::app
