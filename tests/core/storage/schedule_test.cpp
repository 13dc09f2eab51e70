#include "core/storage/schedule.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/storage/acknowledgement.h"
#include "core/storage/backup.h"
#include "core/storage/database.h"
#include "core/storage/kept_study.h"

namespace jnd::core {
namespace schedule_test {

namespace fs = std::filesystem;

class ScheduleTest : public ::testing::Test {
 protected:
  ScheduleTest() { kept_.add_session("P01"); }
  [[nodiscard]] fs::path folder() const { return kept_.folder(); }

  KeptStudy kept_;
};

TEST_F(ScheduleTest, AppointmentsComeByTheirTimeAndTheLastWordOfEachCounts) {
  EXPECT_TRUE(appointments(folder()).empty());
  EXPECT_EQ(add_appointment(folder(), "P03", 300, 1), 1);
  EXPECT_EQ(add_appointment(folder(), "P02", 200, 2), 2);
  cancel_appointment(folder(), 1, 3);
  const std::vector<AppointmentRow> all = appointments(folder());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].participant, "P02");
  EXPECT_FALSE(all[0].cancelled);
  EXPECT_EQ(all[1].participant, "P03");
  EXPECT_EQ(all[1].starts_time_ns, 300);
  EXPECT_TRUE(all[1].cancelled);
  EXPECT_EQ(add_appointment(folder(), "P03", 400, 4), 3) << "a number is given once";
}

TEST_F(ScheduleTest, WhatDoesNotStandCannotBeCancelled) {
  EXPECT_THROW(cancel_appointment(folder(), 1, 3), Error);
  (void)add_appointment(folder(), "P03", 300, 1);
  cancel_appointment(folder(), 1, 2);
  EXPECT_THROW(cancel_appointment(folder(), 1, 3), Error);
}

TEST_F(ScheduleTest, ThePlannedNumberIsTheLastOneAndAboveZero) {
  EXPECT_EQ(planned_number(folder()), std::nullopt);
  plan_number(folder(), 12, 1);
  plan_number(folder(), 24, 2);
  EXPECT_EQ(planned_number(folder()), 24);
  EXPECT_THROW(plan_number(folder(), 0, 3), Error);
  EXPECT_EQ(planned_number(folder()), 24);
}

TEST_F(ScheduleTest, NothingOfItIsEverChangedOrDeleted) {
  (void)add_appointment(folder(), "P03", 300, 1);
  plan_number(folder(), 12, 1);
  acknowledge(folder(), {.session = 1, .sequence = 6}, 1);
  Database database(folder() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kAtClose);
  for (const std::string table : {"appointment", "planned_number", "acknowledgement"}) {
    EXPECT_THROW(database.execute("DELETE FROM " + table), Error) << table;
    EXPECT_THROW(database.execute("UPDATE " + table + " SET time_ns = 9"), Error) << table;
  }
}

TEST_F(ScheduleTest, ANoteIsReadOnceAndOnlyWhereItIs) {
  acknowledge(folder(), {.session = 1, .sequence = 6}, 5);
  acknowledge(folder(), {.session = 1, .sequence = 6}, 7);
  ASSERT_EQ(acknowledgements(folder()).size(), 1U);
  EXPECT_EQ(acknowledgements(folder())[0].time_ns, 5);
  EXPECT_EQ(acknowledgements(folder())[0].what, (ReadNote{.session = 1, .sequence = 6}));
  EXPECT_THROW(acknowledge(folder(), {.session = 1, .sequence = 99}, 5), Error);
  EXPECT_THROW(acknowledge(folder(), {.adverse_event = 1}, 5), Error);
}

TEST_F(ScheduleTest, ABackupHasItAndTakesNothingItself) {
  (void)add_appointment(folder(), "P03", 300, 1);
  const fs::path copy = kept_.beside("copy.study");
  (void)back_up(folder(), copy, 2);
  EXPECT_EQ(appointments(copy).size(), 1U);
  EXPECT_THROW((void)add_appointment(copy, "P04", 400, 3), Error);
  EXPECT_THROW(acknowledge(copy, {.session = 1, .sequence = 6}, 3), Error);
  EXPECT_THROW(plan_number(copy, 3, 3), Error);
}

TEST_F(ScheduleTest, NotWhileAnotherProgramWrites) {
  const StudyStore running(folder(), StudyStore::Mode::kReadWrite);
  EXPECT_THROW((void)add_appointment(folder(), "P03", 300, 1), Error);
  EXPECT_THROW(acknowledge(folder(), {.session = 1, .sequence = 6}, 1), Error);
}

}  // namespace schedule_test
}  // namespace jnd::core
