#include "chaos/force_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::chaos {
namespace force_log_test {

constexpr std::int64_t kMs = 1'000'000;

ForceLog::Record record(std::int64_t at_ms, double force_n) {
  ForceLog::Record made{.time_ns = at_ms * kMs, .force_n = core::zero_vectors()};
  made.force_n[2].y() = force_n;
  return made;
}

/// Returns the log of a device that records each tick, with this force until `until_ms` and
/// none afterwards.
ForceLog ticking(double force_n, int until_ms, int end_ms = 2000) {
  ForceLog log;
  for (int at_ms = 1; at_ms < end_ms; ++at_ms) {
    log.records.push_back(record(at_ms, at_ms < until_ms ? force_n : 0.0));
    log.beats_ns.push_back(at_ms * kMs);
  }
  return log;
}

/// Returns the log of a device that records what it is told, and separately when it ran.
ForceLog told_until(double force_n, int until_ms, int end_ms = 2000) {
  ForceLog log = ticking(force_n, until_ms, end_ms);
  std::erase_if(log.records,
                [&](const ForceLog::Record& each) { return each.time_ns >= until_ms * kMs; });
  return log;
}

Happenings promised() {
  return {.most_per_point_n = 6.0,
          .most_in_all_n = 15.0,
          .most_step_n = 2.0,
          .program_starts_ns = {0}};
}

Happenings killed_at(int at_ms) {
  Happenings happenings = promised();
  happenings.revocations.push_back(
      {.cause = "the program was killed", .from_ns = at_ms * kMs, .within_ms = 100});
  return happenings;
}

TEST(ForceLogJudge, FindsNothingAboutADeviceThatKeepsItsPromises) {
  EXPECT_EQ(judged(ticking(1.5, 590), promised()), "");
  EXPECT_EQ(judged(ticking(1.5, 590), killed_at(500)), "");
  EXPECT_EQ(judged({}, killed_at(500)), "");
}

TEST(ForceLogJudge, FindsAForceThatOutlivesItsProgram) {
  const std::string found = judged(ticking(1.5, 650), killed_at(500));
  EXPECT_NE(found.find("1.5 N although the program was killed"), std::string::npos) << found;
  EXPECT_NE(judged(ticking(1.5, 3000), killed_at(500)), "") << "one that never ends";
}

TEST(ForceLogJudge, FindsAForceThatComesBackBeforeAnotherProgram) {
  ForceLog log = ticking(1.5, 590);
  log.records[900] = record(901, 1.0);
  EXPECT_NE(judged(log, killed_at(500)), "");
  Happenings happenings = killed_at(500);
  happenings.program_starts_ns.push_back(800 * kMs);
  EXPECT_EQ(judged(log, happenings), "");
  log.is_of_one_program = true;
  EXPECT_NE(judged(log, happenings), "") << "the other program has a device of its own";
}

TEST(ForceLogJudge, OwesNothingWhereTheCauseWasOverBefore) {
  Happenings happenings = killed_at(500);
  happenings.revocations[0].over_by_ns = 580 * kMs;
  EXPECT_EQ(judged(ticking(1.5, 1900), happenings), "");
  happenings.revocations[0].over_by_ns = 620 * kMs;
  EXPECT_NE(judged(ticking(1.5, 1900), happenings), "");
}

TEST(ForceLogJudge, CountsNoTimeInWhichTheMachineLetNobodyRun) {
  ForceLog log = ticking(1.5, 900);
  const auto is_held_up = [](std::int64_t time_ns) {
    return time_ns > 510 * kMs && time_ns < 890 * kMs;
  };
  std::erase_if(log.records, [&](const auto& each) { return is_held_up(each.time_ns); });
  std::erase_if(log.beats_ns, is_held_up);
  EXPECT_EQ(judged(log, killed_at(500)), "");
}

TEST(ForceLogJudge, FindsAForceThatNobodyRenews) {
  Happenings happenings = promised();
  happenings.longest_standing_ms = 300;
  EXPECT_NE(judged(told_until(1.5, 500), happenings), "");
  EXPECT_EQ(judged(told_until(1.5, 500, 700), happenings), "") << "its process has ended";
  ForceLog halted = told_until(1.5, 500);
  halted.records.push_back(record(740, 0.0));
  EXPECT_EQ(judged(halted, happenings), "");
}

TEST(ForceLogJudge, FindsForcesThatAreNoneOrTooLarge) {
  const Happenings happenings = promised();
  const auto with = [](int point, double force_n) {
    ForceLog log = ticking(1.5, 590);
    log.records[100].force_n[point].y() = force_n;
    return log;
  };
  EXPECT_NE(judged(with(2, NAN), happenings), "");
  EXPECT_NE(judged(with(2, INFINITY), happenings), "");
  EXPECT_NE(judged(with(1, 3.0), happenings), "") << "a step";
  EXPECT_NE(judged(with(2, -1.0), happenings), "") << "a step beyond zero";
  EXPECT_EQ(judged(with(2, 0.5), happenings), "");
  // The limit also holds for a force that rises slowly.
  ForceLog slow;
  for (int i = 0; i < 80; ++i) {
    slow.records.push_back(record(i + 1, 0.1 * i));
    slow.beats_ns.push_back((i + 1) * kMs);
  }
  EXPECT_NE(judged(slow, happenings).find(" N at one point"), std::string::npos);
  for (ForceLog::Record& each : slow.records) {
    each.force_n.fill(0.35 * Eigen::Vector3d(each.force_n[2]));
  }
  EXPECT_EQ(judged(slow, happenings), "");
}

TEST(ForceLogJudge, BearsAForceThatCrossesAHaltAndIsTakenBackAtOnce) {
  ForceLog log;
  for (const double force_n : {0.0, 1.5, 3.0, 0.0, 4.5, 0.0, 0.0}) {
    log.records.push_back(record(static_cast<std::int64_t>(log.records.size()) + 1, force_n));
    log.beats_ns.push_back(log.records.back().time_ns);
  }
  EXPECT_EQ(judged(log, promised()), "");
  log.records[4].force_n[2].y() = 5.5;
  EXPECT_NE(judged(log, promised()), "") << "further than a step from the one before";
  log.records[4].force_n[2].y() = 4.5;
  log.records[5] = record(6, 4.5);
  EXPECT_NE(judged(log, promised()), "") << "it stays";
}

TEST(ForceLogJudge, FindsForceBeforeTheFirstProgram) {
  Happenings happenings = promised();
  happenings.program_starts_ns = {300 * kMs};
  EXPECT_NE(judged(ticking(1.5, 590), happenings), "");
  happenings.program_starts_ns.clear();
  EXPECT_NE(judged(ticking(1.5, 590), happenings), "");
}

TEST(ForceLog, IsReadUpToItsLastWholeRecord) {
  const test_support::TemporaryFolder folder;
  std::string bytes(2 * 128 + 7, '\0');
  const std::int64_t time_ns = 42;
  const double force_n = 1.25;
  std::memcpy(bytes.data() + 128, &time_ns, sizeof time_ns);
  std::memcpy(bytes.data() + 128 + 8 + 8 * 7, &force_n, sizeof force_n);
  test_support::write_file(folder.path() / "log", bytes);
  const ForceLog log = read_force_log(folder.path() / "log");
  ASSERT_EQ(log.records.size(), 2U);
  EXPECT_EQ(log.records[1].time_ns, 42);
  EXPECT_EQ(log.records[1].force_n[2].y(), 1.25);
  EXPECT_EQ(log.beats_ns.size(), 2U);
  EXPECT_TRUE(ForceWatch().has_new_force(folder.path() / "log"));
  EXPECT_FALSE(ForceWatch(128).has_new_force(folder.path() / "log")) << "it may be an old one";
}

}  // namespace force_log_test
}  // namespace jnd::chaos
