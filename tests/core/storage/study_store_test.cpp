#include "core/storage/study_store.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>

#include "core/random_stream.h"
#include "core/storage/database.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace study_store_test {

namespace fs = std::filesystem;

class StudyStoreTest : public ::testing::Test {
 protected:
  fs::path folder() const { return temporary_.path() / "water.study"; }

  /// Returns a store with one session that is ready for events.
  std::unique_ptr<StudyStore> with_session() const {
    auto store = std::make_unique<StudyStore>(folder(), StudyStore::Mode::kCreate);
    const std::string hash = store->add_protocol("water.json", "{}");
    EXPECT_EQ(
        store->add_session({.participant = "P01", .protocol_sha256 = hash, .seed = ~0ULL}), 1);
    return store;
  }

  static Commit event(std::int64_t sequence, const std::string& kind = "note_added") {
    return {.event = {.session = 1, .sequence = sequence, .kind = kind}};
  }

  static Commit answered(std::int64_t sequence, std::int64_t trial, double response) {
    Commit commit = event(sequence, "trial_answered");
    commit.event.trial = trial;
    commit.trial = TrialRow{.session = 1,
                            .trial = trial,
                            .attempt = 1,
                            .sequence = sequence,
                            .block = "group_d",
                            .procedure = "constant_stimuli",
                            .response = response};
    return commit;
  }

 private:
  test_support::TemporaryFolder temporary_;
};

TEST_F(StudyStoreTest, ASessionWithoutAKeptStartBeganWithItsFirstEvent) {
  const auto store = with_session();
  EXPECT_EQ(store->session(1).started_time_ns, 0) << "nothing has happened";
  Commit first = event(1, "session_started");
  first.event.time_ns = 5000;
  store->append(first);
  Commit second = event(2);
  second.event.time_ns = 9000;
  store->append(second);
  EXPECT_EQ(store->session(1).started_time_ns, 5000);
  EXPECT_EQ(store->sessions().at(0).started_time_ns, 5000);
  const std::int64_t other =
      store->add_session({.participant = "P02",
                          .protocol_sha256 = store->session(1).protocol_sha256,
                          .started_time_ns = 4000});
  Commit later = event(1, "session_started");
  later.event.session = other;
  later.event.time_ns = 6000;
  store->append(later);
  EXPECT_EQ(store->session(other).started_time_ns, 4000) << "kept";
}

TEST_F(StudyStoreTest, ASessionCountsUntilEveryAnswerInItIsSetAside) {
  const auto store = with_session();
  const auto excluded = [](std::int64_t sequence, std::int64_t trial, const char* kind) {
    Commit commit = event(sequence, kind);
    commit.event.trial = trial;
    return commit;
  };
  store->append(answered(1, 1, 1.0));
  store->append(answered(2, 2, 0.0));
  store->append(event(3, "session_completed"));
  EXPECT_TRUE(store->overview().at(0).counts());
  store->append(excluded(4, 1, "trial_excluded"));
  EXPECT_TRUE(store->overview().at(0).counts());
  store->append(excluded(5, 2, "trial_excluded"));
  EXPECT_TRUE(store->overview().at(0).is_set_aside);
  EXPECT_FALSE(store->overview().at(0).counts());
  EXPECT_TRUE(store->overview().at(0).completed);
  store->append(excluded(6, 2, "trial_included"));
  EXPECT_TRUE(store->overview().at(0).counts());
}

TEST_F(StudyStoreTest, AStageThatCameSeveralTimesHasItsAnswersOfEachTime) {
  const auto store = with_session();
  for (std::int64_t sequence = 1; sequence <= 4; ++sequence) {
    Commit commit = event(sequence, "item_answered");
    // The third time is corrected.
    const std::int64_t stage = std::min<std::int64_t>(sequence, 3) * 2;
    commit.answers.push_back({.session = 1,
                              .sequence = sequence,
                              .stage = "rest",
                              .item = "tired",
                              .answer = std::to_string(sequence),
                              .stage_index = stage});
    store->append(commit);
  }
  const std::vector<AnswerRow> answers = store->answers(1);
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[0].answer, "1");
  EXPECT_EQ(answers[0].stage_index, 2);
  EXPECT_EQ(answers[1].answer, "2");
  EXPECT_EQ(answers[2].answer, "4");
  EXPECT_EQ(answers[2].stage_index, 6);
}

TEST_F(StudyStoreTest, KeepsEventsAcrossReopeningColumnByColumn) {
  {
    const auto store = with_session();
    Commit commit = event(1, "presentation_started");
    commit.event.time_ns = 123456789012345;
    commit.event.stage = 3;
    commit.event.trial = 5;
    commit.event.attempt = 2;
    commit.event.first_tick = 777;
    commit.event.intensity = 0.1;
    commit.event.data = R"({"interval":"test"})";
    store->append(commit);
  }
  const StudyStore store(folder(), StudyStore::Mode::kReadOnly);
  const std::vector<EventRow> events = store.events(1);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, "presentation_started");
  EXPECT_EQ(events[0].time_ns, 123456789012345);
  EXPECT_EQ(events[0].stage, 3);
  EXPECT_EQ(events[0].trial, 5);
  EXPECT_EQ(events[0].attempt, 2);
  EXPECT_EQ(events[0].first_tick, 777);
  EXPECT_EQ(events[0].last_tick, std::nullopt);
  EXPECT_EQ(events[0].intensity, 0.1);
  EXPECT_EQ(events[0].data, R"({"interval":"test"})");
  ASSERT_EQ(store.sessions().size(), 1U);
  EXPECT_EQ(store.sessions()[0].seed, ~0ULL);
}

TEST_F(StudyStoreTest, AnAnswerToAQuestionStandsAsLongAsThatToItsTrial) {
  const auto store = with_session();
  const auto said = [](std::int64_t sequence, std::int64_t trial, std::int64_t attempt) {
    Commit commit = event(sequence, "question_answered");
    commit.question_answer = QuestionAnswerRow{.session = 1,
                                               .trial = trial,
                                               .attempt = attempt,
                                               .sequence = sequence,
                                               .block = "group_d",
                                               .question = "confidence",
                                               .answer = std::to_string(sequence)};
    return commit;
  };
  store->append(answered(1, 1, 1.0));
  store->append(said(2, 1, 1));
  store->append(answered(3, 2, 1.0));
  store->append(said(4, 2, 1));
  ASSERT_EQ(store->question_answers(1).size(), 2U);
  EXPECT_EQ(store->question_answers(1)[1].answer, "4");
  EXPECT_EQ(store->question_answers(1)[1].block, "group_d");
  Commit undone = event(5, "answer_undone");
  undone.event.trial = 2;
  undone.event.supersedes = 3;
  store->append(undone);
  ASSERT_EQ(store->question_answers(1).size(), 1U) << "gone with the answer to its trial";
  Commit again = answered(6, 2, 0.0);
  again.trial->attempt = 2;
  store->append(again);
  EXPECT_EQ(store->question_answers(1).size(), 1U) << "that of the first attempt stays gone";
  store->append(said(7, 2, 2));
  EXPECT_EQ(store->question_answers(1).size(), 2U);
  Commit excluded = event(8, "trial_excluded");
  excluded.event.trial = 1;
  store->append(excluded);
  EXPECT_EQ(store->question_answers(1).size(), 1U);
  EXPECT_EQ(store->question_answers(1, /*include_excluded=*/true).size(), 2U);
}

TEST_F(StudyStoreTest, TakesAnEventAndItsRowsTogetherOrNotAtAll) {
  const auto store = with_session();
  Commit commit = answered(1, 1, 1.0);
  commit.answers = {
      {.session = 1, .sequence = 1, .stage = "s", .item = "i", .answer = "a"},
      {.session = 1, .sequence = 1, .stage = "s", .item = "i", .answer = "twice"}};
  EXPECT_THROW(store->append(commit), Error);
  EXPECT_TRUE(store->events(1).empty());
  EXPECT_TRUE(store->trials(1).empty());
  store->append(answered(1, 1, 1.0));
  EXPECT_EQ(store->trials(1).size(), 1U);
}

TEST_F(StudyStoreTest, RefusesAGapOrARepetitionInTheSequence) {
  const auto store = with_session();
  store->append(event(1));
  EXPECT_THROW(store->append(event(1)), Error);
  EXPECT_THROW(store->append(event(3)), Error);
  store->append(event(2));
  EXPECT_EQ(store->events(1).size(), 2U);
}

TEST_F(StudyStoreTest, LeavesASupersededAnswerInPlaceButOutOfForce) {
  const auto store = with_session();
  store->append(answered(1, 1, 1.0));
  store->append(answered(2, 2, 0.0));
  Commit undone = event(3, "answer_undone");
  undone.event.supersedes = 1;
  store->append(undone);
  const std::vector<TrialRow> trials = store->trials(1);
  ASSERT_EQ(trials.size(), 1U);
  EXPECT_EQ(trials[0].trial, 2);
  EXPECT_EQ(store->events(1).size(), 3U);
}

TEST_F(StudyStoreTest, SetsATrialAsideAndTakesItBack) {
  const auto store = with_session();
  store->append(answered(1, 1, 1.0));
  Commit excluded = event(2, "trial_excluded");
  excluded.event.trial = 1;
  store->append(excluded);
  EXPECT_TRUE(store->trials(1).empty());
  EXPECT_EQ(store->trials(1, /*include_excluded=*/true).size(), 1U);
  Commit included = event(3, "trial_included");
  included.event.trial = 1;
  store->append(included);
  EXPECT_EQ(store->trials(1).size(), 1U);
}

TEST_F(StudyStoreTest, NeverChangesOrDeletesAnEventOrATrial) {
  with_session()->append(answered(1, 1, 1.0));
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder() / "study.sqlite").c_str(), &database), SQLITE_OK);
  for (const char* sql : {"UPDATE event SET kind = 'x'", "DELETE FROM event",
                          "UPDATE trial SET response = 0", "DELETE FROM trial"}) {
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_CONSTRAINT) << sql;
  }
  sqlite3_close(database);
}

TEST_F(StudyStoreTest, RefusesASecondWriterAndNamesTheReason) {
  const auto store = with_session();
  try {
    const StudyStore second(folder(), StudyStore::Mode::kReadWrite);
    FAIL() << "two writers at once";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found another one at work"), std::string::npos);
  }
  const StudyStore reader(folder(), StudyStore::Mode::kReadOnly);
  EXPECT_EQ(reader.sessions().size(), 1U);
}

TEST_F(StudyStoreTest, WhoOnlyReadsSeesOneMomentWhileAnotherWrites) {
  const auto writer = with_session();
  writer->append(answered(1, 1, 0.0));
  const StudyStore reader(folder(), StudyStore::Mode::kReadOnly);
  writer->append(answered(2, 2, 1.0));
  EXPECT_EQ(reader.events(1).size(), 1U) << "of the moment at which it was opened";
  EXPECT_EQ(reader.trials(1).size(), 1U);
  EXPECT_EQ(StudyStore(folder(), StudyStore::Mode::kReadOnly).trials(1).size(), 2U);
  EXPECT_EQ(writer->trials(1).size(), 2U);
}

TEST_F(StudyStoreTest, RefusesAFormatNewerThanItself) {
  with_session();
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder() / "study.sqlite").c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "INSERT INTO study_format VALUES (999, 'future')", nullptr, nullptr,
               nullptr);
  sqlite3_close(database);
  try {
    const StudyStore store(folder(), StudyStore::Mode::kReadOnly);
    FAIL() << "a newer format was opened";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found 999; open it with a newer jnd"),
              std::string::npos);
  }
}

TEST_F(StudyStoreTest, RefusesAForeignDatabaseAndAMissingFolder) {
  EXPECT_THROW(StudyStore("/nonexistent.study", StudyStore::Mode::kReadOnly), Error);
  fs::create_directories(folder());
  std::ofstream(folder() / "study.sqlite")
      << "this is a text file, not a database at all .......";
  EXPECT_THROW(StudyStore(folder(), StudyStore::Mode::kReadWrite), Error);
}

TEST_F(StudyStoreTest, KeepsAProtocolOnceUnderItsHash) {
  const auto store = with_session();
  const std::string hash = store->add_protocol("again.json", "{}");
  EXPECT_EQ(hash, store->sessions()[0].protocol_sha256);
  EXPECT_EQ(store->protocol(hash).text, "{}");
  EXPECT_THROW((void)store->protocol("0000"), Error);
}

TEST_F(StudyStoreTest, KeepsEachDeviceProfileOnceUnderItsHash) {
  StudyStore store(folder(), StudyStore::Mode::kCreate);
  EXPECT_TRUE(store.device_profiles().empty());
  const std::string hash = store.add_device_profile("{\"name\": \"left\"}");
  EXPECT_EQ(store.add_device_profile("{\"name\": \"left\"}"), hash);
  store.add_device_profile("{}");
  EXPECT_EQ(store.device_profile(hash).text, "{\"name\": \"left\"}");
  ASSERT_EQ(store.device_profiles().size(), 2U);
  EXPECT_EQ(store.device_profiles()[1].text, "{}");
  EXPECT_THROW((void)store.device_profile("0000"), Error);
}

TEST_F(StudyStoreTest, NoDeviceProfileIsChangedOrDeleted) {
  {
    StudyStore store(folder(), StudyStore::Mode::kCreate);
    store.add_device_profile("{}");
  }
  Database database(folder() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  EXPECT_THROW(database.execute("UPDATE device_profile SET text = '[]'"), Error);
  EXPECT_THROW(database.execute("DELETE FROM device_profile"), Error);
}

TEST_F(StudyStoreTest, KeepsLooksAndUnsealingsAsTheyWereTold) {
  {
    StudyStore store(folder(), StudyStore::Mode::kCreate);
    store.add_look({.look = 1,
                    .decision = "go_on",
                    .time_ns = 5,
                    .program_version = "0.1.0",
                    .sessions = {3, 1}});
    store.add_look({.look = 2, .decision = "stop", .sessions = {4}});
    store.add_unsealing({.time_ns = 7, .num_complete = 2, .reason = "a visit"});
    EXPECT_THROW(store.add_look({.look = 2, .decision = "go_on"}), Error)
        << "a look is told once";
    EXPECT_THROW(store.add_look({.look = 4, .decision = "go_on"}), Error) << "none is left out";
  }
  const StudyStore store(folder(), StudyStore::Mode::kReadOnly);
  const std::vector<SequentialLookRow> looks = store.looks();
  ASSERT_EQ(looks.size(), 2U);
  EXPECT_EQ(looks[0].decision, "go_on");
  EXPECT_EQ(looks[0].time_ns, 5);
  EXPECT_EQ(looks[0].program_version, "0.1.0");
  EXPECT_EQ(looks[0].sessions, (std::vector<std::int64_t>{1, 3}));
  EXPECT_EQ(looks[1].decision, "stop");
  ASSERT_EQ(store.unsealings().size(), 1U);
  EXPECT_EQ(store.unsealings()[0].num_complete, 2);
  EXPECT_EQ(store.unsealings()[0].reason, "a visit");
}

TEST_F(StudyStoreTest, NoLookAndNoUnsealingIsChangedOrDeleted) {
  {
    StudyStore store(folder(), StudyStore::Mode::kCreate);
    store.add_look({.look = 1, .decision = "go_on", .sessions = {1}});
    store.add_unsealing({.reason = "a visit"});
  }
  Database database(folder() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  for (const char* sql :
       {"UPDATE sequential_look SET decision = 'stop'", "DELETE FROM sequential_look_session",
        "UPDATE sequential_look_session SET session = 2", "DELETE FROM sequential_look",
        "UPDATE unsealing SET reason = ''", "DELETE FROM unsealing"}) {
    EXPECT_THROW(database.execute(sql), Error) << sql;
  }
}

TEST_F(StudyStoreTest, ListsItsProtocolsInTheOrderInWhichTheyCame) {
  StudyStore store(folder(), StudyStore::Mode::kCreate);
  EXPECT_TRUE(store.protocols().empty());
  store.add_protocol("z.json", "first", "../z.json");
  store.add_protocol("a.json", "second");
  const std::vector<ProtocolRow> protocols = store.protocols();
  ASSERT_EQ(protocols.size(), 2U);
  EXPECT_EQ(protocols[0].text, "first");
  EXPECT_EQ(protocols[0].relative_path, "../z.json");
  EXPECT_EQ(protocols[1].file_name, "a.json");
}

TEST_F(StudyStoreTest, AnOverviewCountsTheAnswersThatStand) {
  const auto store = with_session();
  EXPECT_EQ(store->overview().at(0).last_time_ns, std::nullopt);
  Commit drawn = event(1, "trials_drawn");
  for (const std::int64_t trial : {1, 2, 3}) {
    drawn.design.push_back({.session = 1, .trial = trial, .block = "group_d"});
  }
  store->append(drawn);
  store->append(answered(2, 1, 1.0));
  store->append(answered(3, 2, 1.0));
  Commit undone = event(4, "answer_undone");
  undone.event.supersedes = 3;
  undone.event.time_ns = 77;
  store->append(undone);
  SessionOverview now = store->overview().at(0);
  EXPECT_EQ(now.session, 1);
  EXPECT_EQ(now.num_trials, 3);
  EXPECT_EQ(now.num_answers, 1);
  EXPECT_EQ(now.last_time_ns, 77);
  EXPECT_FALSE(now.completed || now.ended_early);

  // Setting a trial aside changes neither the number of answers nor the time of the last visit.
  Commit excluded = event(5, "trial_excluded");
  excluded.event.trial = 1;
  excluded.event.time_ns = 99;
  store->append(excluded);
  now = store->overview().at(0);
  EXPECT_EQ(now.num_answers, 1);
  EXPECT_EQ(now.last_time_ns, 77);

  store->append(event(6, "session_completed"));
  EXPECT_TRUE(store->overview().at(0).completed);
  const std::int64_t second = store->add_session(
      {.participant = "P02", .protocol_sha256 = store->sessions()[0].protocol_sha256});
  Commit ended = event(1, "session_ended_early");
  ended.event.session = second;
  store->append(ended);
  ASSERT_EQ(store->overview().size(), 2U);
  EXPECT_TRUE(store->overview()[1].ended_early);
  EXPECT_FALSE(store->overview()[1].completed);
}

/// Tests trials that are drawn one after the other, each when the one before is answered.
class AdaptiveTrialsTest : public StudyStoreTest {
 protected:
  AdaptiveTrialsTest() : store_(with_session()) {}

  void draw(std::int64_t trial, std::int64_t stage = 0) {
    Commit commit = event(++sequence_, "trials_drawn");
    commit.design = {
        {.session = 1, .trial = trial, .stage = stage, .sequence = sequence_, .series = 1}};
    store_->append(commit);
  }
  void answer(std::int64_t trial) { store_->append(answered(++sequence_, trial, 1.0)); }
  void undo(std::int64_t trial) {
    Commit commit = event(++sequence_, "answer_undone");
    commit.event.trial = trial;
    commit.event.supersedes = store_->trials(1).back().sequence;
    store_->append(commit);
  }
  [[nodiscard]] std::vector<std::int64_t> in_force() const {
    std::vector<std::int64_t> trials;
    for (const DesignRow& row : store_->design(1)) trials.push_back(row.trial);
    return trials;
  }
  using Trials = std::vector<std::int64_t>;

  std::unique_ptr<StudyStore> store_;
  std::int64_t sequence_ = 0;
};

TEST_F(AdaptiveTrialsTest, WhatWasDrawnForAnAnswerTakenBackIsVoid) {
  draw(1);
  answer(1);
  draw(2);
  answer(2);
  draw(3);
  undo(2);
  EXPECT_EQ(in_force(), (Trials{1, 2}));
  EXPECT_EQ(store_->design(1, /*include_voided=*/true).size(), 3U);
  EXPECT_EQ(store_->overview().front().num_trials, 2);
  answer(2);
  draw(4);
  EXPECT_EQ(in_force(), (Trials{1, 2, 4}));
  undo(2);
  undo(1);
  EXPECT_EQ(in_force(), (Trials{1})) << "the block begins anew";
}

TEST_F(AdaptiveTrialsTest, WhatWasDrawnWithTheTrialStays) {
  Commit commit = event(++sequence_, "trials_drawn");
  for (const std::int64_t trial : {1, 2, 3}) {
    commit.design.push_back({.session = 1, .trial = trial, .sequence = sequence_});
  }
  store_->append(commit);
  answer(1);
  undo(1);
  EXPECT_EQ(in_force(), (Trials{1, 2, 3}));
}

/// The trials of these blocks are mixed.
TEST_F(AdaptiveTrialsTest, WhatWasDrawnForAnotherBlockStays) {
  draw(1, 1);
  draw(2, 2);
  answer(1);
  draw(3, 1);
  answer(2);
  draw(4, 2);
  undo(2);
  EXPECT_EQ(in_force(), (Trials{1, 2, 3})) << "of its own block the next one is void";
  undo(1);
  EXPECT_EQ(in_force(), (Trials{1, 2})) << "and now of the other one, too";
  EXPECT_EQ(store_->overview().front().num_trials, 2);
}

/// The store looks for the trials in force in another order than the view does.
TEST_F(AdaptiveTrialsTest, WhatIsInForceIsWhatTheViewSays) {
  RandomStream random(7, "acts of a session");
  std::int64_t num_trials = 0;
  int num_undone = 0, num_voided = 0;
  for (int act = 0; act < 400; ++act) {
    const std::int64_t next = static_cast<std::int64_t>(store_->trials(1).size()) + 1;
    const std::vector<std::int64_t> drawn = in_force();
    if (next > 1 && random.with_probability(0.35)) {
      undo(store_->trials(1).back().trial);
      ++num_undone;
    } else if (static_cast<std::size_t>(next) <= drawn.size()) {
      answer(drawn[static_cast<std::size_t>(next) - 1]);
    } else {
      ++num_trials;
      draw(num_trials, num_trials % 2);
    }
    Trials by_view;
    Database database(folder() / "study.sqlite", Database::Mode::kReadOnly,
                      Durability::kEveryCommit);
    Statement rows(database, "SELECT trial FROM design_in_force WHERE session = 1 ORDER BY 1");
    while (rows.step()) by_view.push_back(rows.integer(0));
    ASSERT_EQ(in_force(), by_view) << "after act " << act;
    num_voided = static_cast<int>(num_trials) - static_cast<int>(by_view.size());
    ASSERT_EQ(store_->overview().front().num_trials, std::ssize(by_view));
  }
  EXPECT_GT(num_undone, 50);
  EXPECT_GT(num_voided, 10) << "the comparison has to be of something";
}

TEST_F(StudyStoreTest, FilesAreForTheirOwnerOnly) {
  const auto store = with_session();
  EXPECT_EQ(fs::status(folder() / "study.sqlite").permissions() & fs::perms::all,
            fs::perms::owner_read | fs::perms::owner_write);
}

}  // namespace study_store_test
}  // namespace jnd::core
