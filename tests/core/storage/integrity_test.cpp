#include "core/storage/integrity.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "core/storage/recording.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace integrity_test {

namespace fs = std::filesystem;

/// One completed session of one trial: ticks 0 to 4999 are explored, ticks 5000 to 9999
/// presented.
class IntegrityTest : public ::testing::Test {
 protected:
  IntegrityTest() {
    StudyStore store(folder(), StudyStore::Mode::kCreate, Durability::kAtClose);
    const std::string hash = store.add_protocol("x.json", "{}");
    store.add_session({.participant = "P01", .protocol_sha256 = hash, .rate_hz = 1000.0});
    append(store, "session_started");
    append(store, "medium_explored", 0, 4999);
    Commit drawn = next("trials_drawn");
    drawn.design.push_back({.session = 1, .trial = 1, .block = "b"});
    store.append(drawn);
    append(store, "presentation_started", 5000, std::nullopt);
    append(store, "presentation_ended", std::nullopt, 9999);
    Commit answered = next("trial_answered");
    answered.event.trial = 1;
    answered.event.last_tick = 9999;
    answered.trial = TrialRow{
        .session = 1, .trial = 1, .attempt = 1, .sequence = sequence_, .response = 1.0};
    store.append(answered);
    append(store, "session_completed");
    record(0, 9999);
  }

  [[nodiscard]] fs::path folder() const { return temporary_.path() / "x.study"; }
  [[nodiscard]] fs::path recording() const { return folder() / "recordings" / "0001.sqlite"; }

  Commit next(const char* kind) {
    Commit commit;
    commit.event = {.session = 1, .sequence = ++sequence_, .kind = kind};
    return commit;
  }
  void append(StudyStore& store, const char* kind,
              std::optional<std::int64_t> first_tick = std::nullopt,
              std::optional<std::int64_t> last_tick = std::nullopt) {
    Commit commit = next(kind);
    if (std::string(kind).starts_with("presentation")) commit.event.trial = 1;
    commit.event.first_tick = first_tick;
    commit.event.last_tick = last_tick;
    store.append(commit);
  }
  void record(std::int64_t first_tick, std::int64_t last_tick) const {
    RecordingWriter writer(recording(), 1000.0, Durability::kAtClose);
    for (std::int64_t tick = first_tick; tick <= last_tick; ++tick) {
      Sample sample;
      sample.tick = tick;
      sample.tip_position_m[0][0] = 1e-3 * static_cast<double>(tick * tick % 97);
      writer.append(sample);
    }
    writer.flush();
  }
  static void execute(const fs::path& file, const char* sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
  }
  [[nodiscard]] Integrity verified() const {
    return verify(StudyStore(folder(), StudyStore::Mode::kReadOnly));
  }
  /// The only problem, which has to be one of session 1.
  [[nodiscard]] std::string only_problem() const {
    const Integrity integrity = verified();
    EXPECT_FALSE(integrity.complete);
    EXPECT_EQ(integrity.problems.size(), 1U);
    if (integrity.problems.empty()) return "";
    EXPECT_EQ(integrity.problems[0].session, 1);
    return integrity.problems[0].message;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  std::int64_t sequence_ = 0;
};

TEST_F(IntegrityTest, TicksThatNeverRanAreOneRemarkWithTheMost) {
  std::filesystem::remove(recording());
  {
    RecordingWriter writer(recording(), 1000.0, Durability::kAtClose);
    for (std::int64_t tick = 0; tick < 10'000; ++tick) {
      Sample sample;
      sample.tick = tick;
      sample.monotonic_ns = 1'000'000 * (tick + 1);
      if (tick == 3000) sample.num_missed_before = 2;
      if (tick == 7000) sample.num_missed_before = 5;
      const bool is_missed = tick == 2998 || tick == 2999 || (tick >= 6995 && tick < 7000);
      if (!is_missed) writer.append(sample);
    }
  }
  const Integrity integrity = verified();
  EXPECT_TRUE(integrity.complete);
  ASSERT_EQ(integrity.remarks.size(), 1U);
  EXPECT_EQ(
      integrity.remarks[0].message,
      "5 of the ticks 5000 to 9999 of presentation_ended in trial 1 never ran, the most of "
      "2 times (7 ticks in all): the loop was held up");
}

TEST_F(IntegrityTest, CountsWhatAWholeStudyHolds) {
  const Integrity integrity = verified();
  EXPECT_TRUE(integrity.complete);
  EXPECT_TRUE(integrity.problems.empty());
  EXPECT_TRUE(integrity.remarks.empty());
  EXPECT_EQ(integrity.num_sessions, 1);
  EXPECT_EQ(integrity.num_events, 7);
  EXPECT_EQ(integrity.num_trials, 1);
  EXPECT_EQ(integrity.num_samples, 10000);
}

TEST_F(IntegrityTest, ADeviceProfileThatIsDamagedOrMissingIsAProblem) {
  std::string hash;
  {
    StudyStore store(folder(), StudyStore::Mode::kReadWrite, Durability::kAtClose);
    hash = store.add_device_profile("{\"name\": \"left\"}");
  }
  const fs::path study = folder() / "study.sqlite";
  execute(study,
          ("DROP TRIGGER session_is_final; UPDATE session SET device_profile_sha256 = '" +
           hash + "'")
              .c_str());
  EXPECT_TRUE(verified().complete);
  execute(study, "DROP TRIGGER device_profile_is_final; UPDATE device_profile SET text = '{}'");
  EXPECT_NE(only_problem().find("expected the text of its device profile to fit its hash"),
            std::string::npos);
  execute(study, "DROP TRIGGER device_profile_stays; DELETE FROM device_profile");
  EXPECT_NE(only_problem().find("expected the device profile that it was begun with"),
            std::string::npos);
}

TEST_F(IntegrityTest, AChunkThatDoesNotHoldWhatItsRowSaysIsDamaged) {
  for (const char* damage : {"num_samples = num_samples + 3", "num_samples = -1",
                             "num_samples = 9000000000000000000", "first_tick = -5"}) {
    fs::copy(recording(), recording().string() + ".sound");
    execute(recording(), ("UPDATE chunk SET " + std::string(damage) +
                          " WHERE rowid = (SELECT MAX(rowid) FROM chunk)")
                             .c_str());
    EXPECT_FALSE(verified().complete) << damage;
    fs::rename(recording().string() + ".sound", recording());
    fs::remove(recording().string() + "-wal");
    fs::remove(recording().string() + "-shm");
  }
}

TEST_F(IntegrityTest, ARecordingThatNoSessionKnowsIsAProblem) {
  fs::copy(recording(), folder() / "recordings" / "0007.sqlite");
  const Integrity integrity = verified();
  EXPECT_FALSE(integrity.complete);
  EXPECT_NE(integrity.problems.at(0).message.find("0007.sqlite: expected a session"),
            std::string::npos);
}

TEST_F(IntegrityTest, ADamagedChunkIsNamedWithItsTicks) {
  execute(
      recording(),
      "UPDATE chunk SET data = CAST(x'00' || substr(data, 2) AS BLOB) WHERE first_tick = 0");
  const Integrity integrity = verified();
  EXPECT_FALSE(integrity.complete);
  ASSERT_GE(integrity.problems.size(), 2U);
  EXPECT_EQ(integrity.problems[0].session, 1);
  EXPECT_NE(integrity.problems[0].message.find("ticks 0 to 4095"), std::string::npos)
      << integrity.problems[0].message;
  // The ticks that were explored in the bad chunk are missing, too.
  EXPECT_NE(integrity.problems[1].message.find("ticks 0 to 4999"), std::string::npos)
      << integrity.problems[1].message;
}

TEST_F(IntegrityTest, ADeletedRecordingIsAProblem) {
  fs::remove(recording());
  EXPECT_NE(only_problem().find("0001.sqlite"), std::string::npos);
}

TEST_F(IntegrityTest, ATruncatedTrialIsNamedWithItsTicksAndHowManyAreMissing) {
  fs::remove(recording());
  record(0, 9899);
  const std::string problem = only_problem();
  EXPECT_NE(problem.find("ticks 5000 to 9999"), std::string::npos) << problem;
  EXPECT_NE(problem.find("trial 1"), std::string::npos) << problem;
  EXPECT_NE(problem.find("100 of them missing"), std::string::npos) << problem;
}

TEST_F(IntegrityTest, AHoleBetweenTwoSegmentsIsFound) {
  fs::remove(recording());
  record(0, 6999);
  record(7001, 9999);
  EXPECT_NE(only_problem().find("found 1 of them missing"), std::string::npos);
}

TEST_F(IntegrityTest, SegmentsThatOverlapOrTouchAreWhole) {
  fs::remove(recording());
  record(0, 6999);
  record(6000, 8000);
  record(8001, 9999);
  EXPECT_TRUE(verified().complete);
}

TEST_F(IntegrityTest, TicksThatNoEventSpeaksOfAreNoProblem) {
  record(10000, 12000);
  EXPECT_TRUE(verified().complete);
}

TEST_F(IntegrityTest, EventsThatAreMissingAreNamed) {
  execute(folder() / "study.sqlite",
          "DROP TRIGGER event_stays; DELETE FROM event WHERE sequence = 3;");
  EXPECT_NE(only_problem().find("expected event 3, found 4"), std::string::npos);
}

TEST_F(IntegrityTest, AnAnswerThatIsMissingFromACompletedSessionIsAProblem) {
  execute(folder() / "study.sqlite", "DROP TRIGGER trial_stays; DELETE FROM trial;");
  EXPECT_NE(only_problem().find("1 drawn trials without an answer"), std::string::npos);
}

TEST_F(IntegrityTest, ASessionThatHasNotBegunNeedsNoRecording) {
  {
    StudyStore store(folder(), StudyStore::Mode::kReadWrite, Durability::kAtClose);
    const std::string hash = store.add_protocol("x.json", "{}");
    store.add_session({.participant = "P02", .protocol_sha256 = hash});
  }
  const Integrity integrity = verified();
  EXPECT_TRUE(integrity.complete);
  ASSERT_EQ(integrity.remarks.size(), 1U);
  EXPECT_EQ(integrity.remarks[0].session, 2);
}

TEST_F(IntegrityTest, AMalformedDatabaseIsFoundNotThrown) {
  const fs::path file = folder() / "study.sqlite";
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  int page = 0;
  ASSERT_EQ(sqlite3_exec(
                database, "SELECT rootpage FROM sqlite_master WHERE name = 'event'",
                [](void* found, int, char** cells, char**) {
                  *static_cast<int*>(found) = std::atoi(cells[0]);
                  return 0;
                },
                &page, nullptr),
            SQLITE_OK);
  sqlite3_close(database);
  ASSERT_GT(page, 1);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(std::streamoff{4096} * (page - 1));
  stream << std::string(4096, '\x7f');
  stream.close();
  const Integrity integrity = verified();
  EXPECT_FALSE(integrity.complete);
  EXPECT_FALSE(integrity.problems.empty());
}

TEST_F(IntegrityTest, ReadsAStudyInAFolderThatNobodyCanWriteTo) {
  for (const auto& entry : fs::recursive_directory_iterator(folder())) {
    const bool is_folder = entry.is_directory();
    fs::permissions(entry.path(), is_folder ? fs::perms(0555) : fs::perms(0444));
  }
  fs::permissions(folder(), fs::perms(0555));
  fs::permissions(temporary_.path(), fs::perms(0755));
  const pid_t child = ::fork();
  if (child == 0) {
    // Root may write anywhere, so the reader becomes the user nobody.
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(2);
    try {
      ::_exit(verified().complete ? 0 : 1);
    } catch (...) {
      ::_exit(3);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  for (const fs::path& path : {temporary_.path(), folder(), folder() / "recordings"}) {
    fs::permissions(path, fs::perms::owner_all);
  }
}

TEST_F(IntegrityTest, AStudyIsMadeAnewWhereTheDeathCameBeforeItsFirstTable) {
  // A program that was killed between making the file and filling it leaves this.
  const fs::path half_made = temporary_.path() / "half.study";
  fs::create_directories(half_made / "recordings");
  execute(half_made / "study.sqlite", "PRAGMA journal_mode = WAL; VACUUM;");
  EXPECT_GT(fs::file_size(half_made / "study.sqlite"), 0U);
  StudyStore store(half_made, StudyStore::Mode::kCreate);
  EXPECT_TRUE(store.sessions().empty());
}

}  // namespace integrity_test
}  // namespace jnd::core
