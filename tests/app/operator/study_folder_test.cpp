#include "app/operator/study_folder.h"

#include <gtest/gtest.h>

#include <ctime>

#include "app/environment.h"
#include "app/operator/simulated_study.h"
#include "core/error.h"
#include "core/storage/backup.h"
#include "experiments/study/study_problem.h"

namespace jnd::app {
namespace study_folder_test {

namespace fs = std::filesystem;
using Status = SessionLine::Status;

/// Returns every word of a folder that a view could show.
std::string all_words(const StudyFolder& study) {
  std::string words = study.title + study.summary();
  for (const SessionLine& line : study.sessions) {
    words += line.participant + line.cells + line.when + line.device;
  }
  for (const InterruptedSession& open : study.interrupted) {
    words += open.sentence() + open.safe() + open.problem;
  }
  return words;
}

TEST(StudyFolder, KnowsItsStudyBeforeTheFirstSession) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  const StudyFolder study = open_study_folder(made.folder());
  EXPECT_EQ(study.name, "tiny");
  EXPECT_EQ(study.title, "Tiny");
  EXPECT_EQ(study.folder, made.folder());
  EXPECT_EQ(study.study_file, made.file());
  EXPECT_EQ(study.num_sessions, 0);
  EXPECT_TRUE(study.sessions.empty());
  EXPECT_EQ(study.summary(), "no session yet");
  const core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadOnly);
  EXPECT_EQ(study_in(store).text, kTinyStudy);
}

TEST(StudyFolder, ASessionBegunInACreatedFolderIsOfTheSameStudy) {
  SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  made.simulate(1);
  const core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadOnly);
  EXPECT_EQ(store.protocols().size(), 1U);
}

TEST(StudyFolder, IsNeverMadeWhereSomethingIsAlready) {
  const SimulatedStudy made;
  fs::create_directories(made.folder());
  EXPECT_THROW(create_study_folder(made.file(), made.folder()), core::Error);
  EXPECT_TRUE(fs::is_empty(made.folder()));
  EXPECT_THROW(create_study_folder(made.file(), made.file()), core::Error);
}

TEST(StudyFolder, IsNotMadeForAStudyWithProblems) {
  const SimulatedStudy made;
  const fs::path wrong =
      write_file(made.temporary() / "wrong.json", replaced(kTinyStudy, "\"tiny\"", "7"));
  EXPECT_THROW(create_study_folder(wrong, made.folder()), experiments::ProtocolError);
  EXPECT_FALSE(fs::exists(made.folder()));
}

TEST(StudyFolder, CountsWhoIsDoneAndWhoIsNot) {
  SimulatedStudy made;
  made.simulate(2);
  (void)made.interrupt(3);
  (void)made.interrupt(1, /*pilot=*/true);
  const StudyFolder study = open_study_folder(made.folder());
  EXPECT_EQ(study.num_participants_done, 2);
  EXPECT_EQ(study.num_sessions, 4);
  EXPECT_EQ(study.num_open, 2);
  EXPECT_EQ(study.num_pilots, 1);
  EXPECT_TRUE(study.simulated);
  EXPECT_EQ(study.summary(), "2 participants done, 2 open, 1 pilot · simulated");
  ASSERT_EQ(study.sessions.size(), 4U);
  EXPECT_EQ(study.sessions[0].participant, "P01");
  EXPECT_EQ(study.sessions[0].status, Status::kCompleted);
  EXPECT_EQ(study.sessions[0].num_answers, kTinyTrials);
  EXPECT_EQ(study.sessions[0].num_trials, kTinyTrials);
  EXPECT_EQ(study.sessions[0].when, "") << "simulated time has no date";
  EXPECT_EQ(study.sessions[2].status, Status::kOpen);
  EXPECT_EQ(study.sessions[2].num_answers, 3);
  EXPECT_EQ(study.sessions[2].num_trials, kTinyTrials)
      << "blocks that nobody has come to count as well";
  EXPECT_TRUE(study.sessions[3].pilot);
  EXPECT_EQ(study.sessions[3].device, "lumped");
}

TEST(StudyFolder, WhoseEveryAnswerIsSetAsideIsNotDone) {
  SimulatedStudy made;
  made.simulate(2);
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    auto sequence = static_cast<std::int64_t>(store.events(2).size());
    for (std::int64_t trial = 1; trial <= kTinyTrials; ++trial) {
      store.append({.event = {.session = 2,
                              .sequence = ++sequence,
                              .kind = "trial_excluded",
                              .trial = trial,
                              .data = R"({"reason":"fire alarm"})"}});
    }
  }
  const StudyFolder study = open_study_folder(made.folder());
  EXPECT_EQ(study.num_participants_done, 1);
  EXPECT_EQ(study.sessions.at(1).status, Status::kCompleted) << "it stays in the list";
}

TEST(StudyFolder, APilotIsNobodyDone) {
  SimulatedStudy made;
  made.simulate(1, /*record=*/false, /*pilot=*/true);
  EXPECT_EQ(open_study_folder(made.folder()).summary(),
            "0 participants done, 1 pilot · simulated");
}

TEST(StudyFolder, SaysWhereASessionWasInterruptedAndWhatIsSafe) {
  SimulatedStudy made;
  const std::int64_t session = made.interrupt(4 + 2 + 1);
  const StudyFolder study = open_study_folder(made.folder());
  ASSERT_EQ(study.interrupted.size(), 1U);
  const InterruptedSession& open = study.interrupted.front();
  EXPECT_EQ(open.session, session);
  // There were four estimations and two productions before, and one of four comparisons is
  // answered.
  EXPECT_EQ(open.sentence(), "P01 was interrupted in Comparison, trial 2 of 4");
  EXPECT_EQ(open.num_answers, 7);
  const core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadOnly);
  EXPECT_GT(open.recorded_min, 0.0);
  EXPECT_EQ(open.safe().find("7 answers"), 0U) << open.safe();
}

TEST(StudyFolder, OutsideOfABlockThereIsNoTrial) {
  SimulatedStudy made;
  (void)made.interrupt(0);
  const StudyFolder study = open_study_folder(made.folder());
  EXPECT_EQ(study.interrupted.front().num_trials, 0);
  EXPECT_EQ(study.interrupted.front().sentence(), "P01 was interrupted in Before");
  EXPECT_EQ(study.interrupted.front().safe(), "0 answers are safe on disk");
}

TEST(StudyFolder, TheLatestInterruptionComesFirst) {
  SimulatedStudy made;
  (void)made.interrupt(1);
  (void)made.interrupt(2);
  const StudyFolder study = open_study_folder(made.folder());
  ASSERT_EQ(study.interrupted.size(), 2U);
  EXPECT_EQ(study.interrupted[0].participant, "P02");
}

TEST(StudyFolder, ADamagedLogIsToldAndTheOthersAreStillShown) {
  SimulatedStudy made;
  (void)made.interrupt(1);
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    store.append({.event = {.session = 1,
                            .sequence = std::ssize(store.events(1)) + 1,
                            .kind = "of_the_future"}});
  }
  const StudyFolder study = open_study_folder(made.folder());
  EXPECT_NE(study.interrupted.front().problem.find("of_the_future"), std::string::npos);
  EXPECT_EQ(study.interrupted.front().num_answers, 1);
}

TEST(StudyFolder, ADoubleBlindStudyTellsNoBlockUntilItIsUnblinded) {
  SimulatedStudy made(replaced(kDoubleBlindStudy, R"("name": "comparison",)",
                               R"("name": "comparison", "title": {"en": "Group D"},)"));
  (void)made.interrupt(7);
  {
    const StudyFolder study = open_study_folder(made.folder());
    EXPECT_TRUE(study.hides_levels);
    EXPECT_EQ(study.interrupted.front().stage, "Block 3");
    EXPECT_EQ(all_words(study).find("Group"), std::string::npos) << all_words(study);
  }
  core::StudyStore(made.folder(), core::StudyStore::Mode::kReadWrite).add_unblinding(1, "done");
  const StudyFolder study = open_study_folder(made.folder());
  EXPECT_FALSE(study.hides_levels);
  EXPECT_EQ(study.interrupted.front().stage, "Group D");
}

TEST(StudyFolder, TheOrderAssignedIsShownUnlessItIsHidden) {
  for (const bool blind : {false, true}) {
    SimulatedStudy made(blind ? replaced(kCounterbalancedStudy, R"("languages")",
                                         R"("blinding": "double", "languages")")
                              : kCounterbalancedStudy);
    made.simulate(1);
    const std::string cells = open_study_folder(made.folder()).sessions.front().cells;
    if (blind) {
      EXPECT_EQ(cells, "");
    } else {
      EXPECT_TRUE(cells == "first arm, then second arm" ||
                  cells == "second arm, then first arm")
          << cells;
    }
  }
}

TEST(StudyFolder, KnowsItsBackups) {
  SimulatedStudy made;
  made.simulate(1);
  (void)core::back_up(made.folder(), made.temporary() / "copy", 1);
  EXPECT_EQ(open_study_folder(made.folder()).backups,
            std::vector<fs::path>{made.temporary() / "copy"});
}

TEST(StudyFolder, ABackupSaysWhatItIsAndOffersNothingToResume) {
  SimulatedStudy made;
  (void)made.interrupt(3);
  ASSERT_EQ(open_study_folder(made.folder()).interrupted.size(), 1U);
  (void)core::back_up(made.folder(), made.temporary() / "copy", 1);
  const StudyFolder backup = open_study_folder(made.temporary() / "copy");
  EXPECT_TRUE(backup.is_backup);
  EXPECT_TRUE(backup.interrupted.empty());
  EXPECT_EQ(backup.sessions.size(), 1U);
  EXPECT_TRUE(backup.summary().starts_with("backup, to be read only")) << backup.summary();
  const StudyFolder study = open_study_folder(made.folder());
  EXPECT_FALSE(study.is_backup);
  EXPECT_FALSE(study.is_safe_elsewhere);
}

TEST(StudyFolder, AnythingElseIsRefusedWithAReason) {
  const SimulatedStudy made;
  EXPECT_THROW((void)open_study_folder(made.temporary() / "none"), core::Error);
  EXPECT_THROW((void)open_study_folder(made.temporary()), core::Error);
  const core::StudyStore empty(made.folder(), core::StudyStore::Mode::kCreate);
  EXPECT_THROW((void)open_study_folder(made.folder()), core::Error);
}

TEST(StudyFolder, ANewOneNeverTakesTheNameOfAnother) {
  const test_support::TemporaryFolder temporary;
  const EnvironmentVariable data("XDG_DATA_HOME", temporary.path().c_str());
  const fs::path first = default_study_folder("honey");
  EXPECT_EQ(first, temporary.path() / "jnd" / "honey.study");
  fs::create_directories(first);
  EXPECT_EQ(default_study_folder("honey"), temporary.path() / "jnd" / "honey-2.study");
  const EnvironmentVariable no_data("XDG_DATA_HOME", nullptr);
  const EnvironmentVariable home("HOME", "/home/me");
  EXPECT_EQ(default_study_folder("honey"), "/home/me/jnd/honey.study");
}

class DayInWords : public ::testing::Test {
 protected:
  DayInWords() { ::tzset(); }
  static std::int64_t at(int year, int month, int day, int hour) {
    std::tm parts{};
    parts.tm_year = year - 1900;
    parts.tm_mon = month - 1;
    parts.tm_mday = day;
    parts.tm_hour = hour;
    parts.tm_isdst = -1;
    return std::int64_t{std::mktime(&parts)} * 1'000'000'000;
  }
  // In this time zone, summer time ends on 27 October 2024.
  EnvironmentVariable zone_{"TZ", "CET-1CEST,M3.5.0,M10.5.0/3"};
};

TEST_F(DayInWords, IsTheNearestWordForIt) {
  const std::int64_t now = at(2024, 11, 20, 1);
  EXPECT_EQ(day_in_words(at(2024, 11, 20, 0), now), "today");
  EXPECT_EQ(day_in_words(at(2024, 11, 20, 23), now), "today");
  EXPECT_EQ(day_in_words(at(2024, 11, 19, 23), now), "yesterday");
  EXPECT_EQ(day_in_words(at(2024, 11, 19, 0), now), "yesterday");
  EXPECT_EQ(day_in_words(at(2024, 11, 18, 23), now), "18 November");
  EXPECT_EQ(day_in_words(at(2023, 11, 20, 1), now), "20 November 2023");
  EXPECT_EQ(day_in_words(at(2023, 12, 31, 23), at(2024, 1, 1, 0)), "yesterday");
  EXPECT_EQ(day_in_words(at(2024, 10, 27, 0), at(2024, 10, 28, 0)), "yesterday");
}

TEST_F(DayInWords, SimulatedTimeIsNoDay) {
  EXPECT_EQ(day_in_words(3'600'000'000'000, at(2024, 11, 20, 1)), "");
  EXPECT_EQ(day_in_words(0, 0), "");
}

}  // namespace study_folder_test
}  // namespace jnd::app
