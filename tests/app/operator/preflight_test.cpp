#include "app/operator/preflight.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/operator/simulated_study.h"
#include "app/operator/study_folder.h"
#include "app/session/machine_checks.h"
#include "core/error.h"
#include "support/wide_profile.h"

namespace jnd::app {
namespace preflight_test {

using Status = PreflightLine::Status;

TEST(Preflight, AnHourAtAKilohertzIsCountedWithFifteenBytesASample) {
  // 1000 Hz * 3600 s * 15 bytes + 1 MB = 55 MB.
  const PreflightLine plenty = disk_line(55e9, 1000.0, 3600.0);
  EXPECT_EQ(plenty.status, Status::kOk);
  EXPECT_EQ(plenty.found, "55 GB free, about 1000 sessions");
  EXPECT_EQ(plenty.remedy, "");
  const PreflightLine little = disk_line(5.5e8 - 1.0, 1000.0, 3600.0);
  EXPECT_EQ(little.status, Status::kWarning);
  EXPECT_EQ(little.found, "550 MB free, about 9 sessions");
  EXPECT_NE(little.remedy, "");
  EXPECT_EQ(disk_line(5.5e7, 1000.0, 3600.0).found, "55 MB free, about 1 session");
  const PreflightLine none = disk_line(5.4e7, 1000.0, 3600.0);
  EXPECT_EQ(none.status, Status::kFailed);
  EXPECT_EQ(none.found, "54 MB free, less than a session");
  EXPECT_EQ(disk_line(1e13, 1000.0, 3600.0).found, "10000 GB free, more than 10000 sessions");
}

TEST(Preflight, ALoopThatMissesTicksIsNoLoopForAPerson) {
  LoopTest test{.rate_hz = 1000.0, .duration_s = 2.0, .lateness_p99_us = 30.4};
  EXPECT_EQ(loop_line(test).status, Status::kOk);
  EXPECT_EQ(loop_line(test).name, "Loop at 1 kHz for 2 s");
  EXPECT_EQ(loop_line(test).found, "none missed, 99 % within 30 µs");
  test.lateness_p99_us = 0.42;
  EXPECT_EQ(loop_line(test).found, "none missed, 99 % within 0.4 µs");
  test.lateness_p99_us = 201.0;
  EXPECT_EQ(loop_line(test).status, Status::kWarning) << "more than a fifth of its period";
  test.missed_ticks = 3;
  EXPECT_EQ(loop_line(test).status, Status::kWarning);
  EXPECT_EQ(loop_line(test).found, "3 ticks missed, 99 % within 201 µs");
  test.for_a_person = true;
  EXPECT_EQ(loop_line(test).status, Status::kFailed);
  EXPECT_NE(loop_line(test).remedy, "");
  EXPECT_EQ(loop_line({.rate_hz = 1000.0, .duration_s = 2.0, .fault = "gone"}).remedy, "gone");
}

std::vector<experiments::RangeEntry> two_stimuli(bool second_fits) {
  return {{.stage = "a", .total_force_n = 8.25, .fits = true},
          {.stage = "b", .total_force_n = 17.5, .fits = second_fits}};
}

TEST(Preflight, StimuliBeyondTheDeviceFail) {
  const experiments::RangeLimits limits{.max_force_per_point_n = 10, .max_total_force_n = 30};
  const PreflightLine fine = stimuli_line(two_stimuli(true), limits, false);
  EXPECT_EQ(fine.status, Status::kOk);
  EXPECT_EQ(fine.found, "2 of 2 within limits, up to 17.5 of 30 N");
  const PreflightLine wrong = stimuli_line(two_stimuli(false), limits, false);
  EXPECT_EQ(wrong.status, Status::kFailed);
  EXPECT_NE(wrong.remedy, "");
}

TEST(Preflight, OfADoubleBlindStudyOnlyTheNumberOfStimuliIsTold) {
  const experiments::RangeLimits limits{.max_force_per_point_n = 10, .max_total_force_n = 30};
  EXPECT_EQ(stimuli_line(two_stimuli(false), limits, true).found, "1 of 2 within limits");
}

TEST(Preflight, TheStudyFileIsComparedWithTheOneInTheFolder) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  EXPECT_EQ(study_file_line(made.folder()).found, "sound and unchanged");
  write_file(made.file(), kTinyStudy + "\n");
  EXPECT_EQ(study_file_line(made.folder()).status, Status::kWarning);
  EXPECT_EQ(study_file_line(made.folder()).found, "changed since the study began");
  std::filesystem::remove(made.file());
  EXPECT_EQ(study_file_line(made.folder()).status, Status::kOk);
  EXPECT_EQ(study_file_line(made.folder()).found, "sound, kept in the folder");
  EXPECT_EQ(study_file_line(made.temporary() / "none").status, Status::kFailed);
}

TEST(Preflight, AFolderThatSomebodyElseWritesToFails) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  EXPECT_EQ(folder_line(made.folder()).status, Status::kOk);
  const core::StudyStore other(made.folder(), core::StudyStore::Mode::kReadWrite);
  const PreflightLine taken = folder_line(made.folder());
  EXPECT_EQ(taken.status, Status::kFailed);
  EXPECT_NE(taken.remedy.find("close it first"), std::string::npos) << taken.remedy;
}

TEST(Preflight, AStudyThatItsRuleHasEndedIsAWarning) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    store.add_look({.look = 1, .decision = "stop", .time_ns = 1, .program_version = "0"});
  }
  const PreflightLine ended = folder_line(made.folder());
  EXPECT_EQ(ended.status, Status::kWarning);
  EXPECT_EQ(ended.found, "ended by the rule of the study");
}

TEST(Preflight, TheDeviceHasToStartAndToHoldEnoughOfTheHand) {
  EXPECT_EQ(device_line("lumped", 1000.0, 5).status, Status::kOk);
  EXPECT_EQ(device_line("lumped", 1000.0, 5).found, "lumped, simulated");
  EXPECT_EQ(device_line("lumped", 1000.0, 6).found, "holds 5 of 6 points of the hand");
  EXPECT_EQ(device_line("unplugged", 1000.0, 1).status, Status::kFailed);
  EXPECT_NE(device_line("unplugged", 1000.0, 1).remedy.find("cable"), std::string::npos);
  EXPECT_EQ(device_line("unobtainable", 1000.0, 1).status, Status::kFailed);
}

TEST(Preflight, TellsWhatTheLinkToADeviceWillCost) {
  const auto line = [](const device::LinkReport& link) {
    return loop_line({.rate_hz = 1000.0,
                      .duration_s = 2.0,
                      .lateness_p99_us = 5.0,
                      .for_a_person = true,
                      .link = link});
  };
  const PreflightLine good = line({.level = "good",
                                   .may_arm = true,
                                   .may_give_force = true,
                                   .lost_ratio = 0.004,
                                   .round_trip_s = 0.0031});
  EXPECT_EQ(good.status, Status::kOk);
  EXPECT_NE(good.found.find("link good: 0.4 % lost, 3.1 ms there and back"), std::string::npos)
      << good.found;
  const PreflightLine poor = line({.level = "poor", .may_give_force = true});
  EXPECT_EQ(poor.status, Status::kWarning);
  EXPECT_NE(poor.remedy.find("every fault holds the session up"), std::string::npos);
  const PreflightLine bad = line({.level = "unacceptable"});
  EXPECT_EQ(bad.status, Status::kFailed);
  EXPECT_NE(bad.remedy.find("no force"), std::string::npos);
}

TEST(Preflight, LooksAtEverythingAndTellsOfEachLineAsItComes) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  WorkControl control;
  std::vector<std::size_t> num_waiting;
  const std::vector<PreflightLine> lines = look_before_session(
      {.folder = made.folder(), .loop_test_s = 0.05}, control,
      [&](const std::vector<PreflightLine>& now) {
        num_waiting.push_back(static_cast<std::size_t>(std::count_if(
            now.begin(), now.end(),
            [](const PreflightLine& line) { return line.status == Status::kWaiting; })));
      });
  EXPECT_EQ(num_waiting, (std::vector<std::size_t>{9, 8, 7, 6, 5, 4, 3, 2, 1, 0}));
  ASSERT_EQ(lines.size(), 9U);
  for (const PreflightLine& line : lines) {
    EXPECT_NE(line.status, Status::kFailed) << line.name << ": " << line.found << line.remedy;
    EXPECT_FALSE(line.found.empty()) << line.name;
    EXPECT_EQ(line.remedy.empty(), line.status == Status::kOk) << line.name;
  }
  EXPECT_EQ(lines.back().name, "Loop at 1 kHz for 0.05 s");
  EXPECT_EQ(control.ratio(), 1.0);
}

TEST(Preflight, TellsWhatWasMeasuredOfTheDeviceAndWhyNothingIsBegunOnIt) {
  const PreflightLine sound{.name = "Device", .status = Status::kOk, .found = "wam"};
  EXPECT_EQ(with_profile(sound, std::nullopt, "").found, "wam");
  KnownProfile known{.profile = test_support::wide_profile("wam")};
  EXPECT_EQ(with_profile(sound, known, "").found,
            "wam, measured on 2026-11-20, valid until 2999-12-31");
  EXPECT_EQ(with_profile(sound, known, "").status, Status::kOk);
  known.profile.simulated = true;
  EXPECT_NE(with_profile(sound, known, "").found.find("SIMULATED"), std::string::npos);
  const PreflightLine refused = with_profile(sound, std::nullopt, "expected a profile");
  EXPECT_EQ(refused.status, Status::kFailed);
  EXPECT_EQ(refused.remedy, "expected a profile");
}

TEST(Preflight, ComparesTheStimuliWithTheProfileThatIsGiven) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  const test_support::TemporaryFolder folder;
  experiments::DeviceProfile weak = test_support::wide_profile("lumped");
  weak.limits.max_total_force_n = 0.1;
  const std::filesystem::path file = experiments::write_device_profile(weak, folder.path());
  const auto stimuli = [&](const std::string& profile) {
    WorkControl control;
    return look_before_session(
               {.folder = made.folder(), .profile = profile, .loop_test_s = 0.02}, control, {})
        .at(7);
  };
  EXPECT_EQ(stimuli("").status, Status::kOk);
  EXPECT_EQ(stimuli(file.string()).status, Status::kFailed);
}

TEST(Preflight, TellsNoForceOfADoubleBlindStudyUntilItIsUnblinded) {
  SimulatedStudy made(kDoubleBlindStudy);
  create_study_folder(made.file(), made.folder());
  const auto stimuli = [&made] {
    WorkControl control;
    return look_before_session({.folder = made.folder(), .loop_test_s = 0.02}, control, {})[7];
  };
  EXPECT_EQ(stimuli().found, "8 of 8 within limits");
  core::StudyStore(made.folder(), core::StudyStore::Mode::kReadWrite).add_unblinding(1, "done");
  EXPECT_NE(stimuli().found.find("up to"), std::string::npos);
}

TEST(Preflight, WithoutAStudyItFailsButSaysTheRest) {
  const test_support::TemporaryFolder temporary;
  WorkControl control;
  const std::vector<PreflightLine> lines = look_before_session(
      {.folder = temporary.path() / "none", .loop_test_s = 0.02}, control, {});
  EXPECT_EQ(lines[0].status, Status::kFailed);
  EXPECT_EQ(lines[6].status, Status::kOk) << "the device";
  EXPECT_EQ(lines[7].remedy, "mend the study first");
}

TEST(Preflight, RunsBesideTheWindowAndPasses) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  Preflight preflight({.folder = made.folder(), .loop_test_s = 0.02});
  EXPECT_FALSE(preflight.passed());
  preflight.wait();
  EXPECT_TRUE(preflight.passed());
  EXPECT_EQ(preflight.lines().size(), 9U);
  Preflight unplugged({.folder = made.folder(), .device = "unplugged", .loop_test_s = 0.02});
  unplugged.wait();
  EXPECT_FALSE(unplugged.passed());
}

TEST(Preflight, CanBeCancelled) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  Preflight preflight({.folder = made.folder(), .loop_test_s = 3600.0});
  preflight.cancel();
  preflight.wait();
  EXPECT_FALSE(preflight.running());
  EXPECT_FALSE(preflight.passed());
}

TEST(Preflight, TheMachineIsLookedAtQuickly) {
  const std::vector<PreflightLine> lines = look_at_machine();
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[2].name, "Disk");
  // The lumped hand, the exoskeleton and the mouse start everywhere, and "unplugged" starts
  // nowhere.
  EXPECT_EQ(lines[3].found, "none connected, 4 simulated");
}

TEST(MachineChecks, FreeSpaceIsThatOfTheFolderThatWillHoldThePath) {
  const test_support::TemporaryFolder temporary;
  const auto here = free_bytes(temporary.path());
  const auto later = free_bytes(temporary.path() / "not" / "yet" / "made");
  ASSERT_TRUE(here && later);
  EXPECT_NEAR(*later, *here, 1e9);
  EXPECT_GT(*here, 0.0);
}

}  // namespace preflight_test
}  // namespace jnd::app
