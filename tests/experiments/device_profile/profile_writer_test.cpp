#include "experiments/device_profile/profile_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "experiments/device_profile/profile_reader.h"
#include "support/sound_profile.h"
#include "support/temporary_folder.h"

namespace jnd::experiments {
namespace profile_writer_test {

namespace fs = std::filesystem;
using test_support::sound_profile;
using test_support::TemporaryFolder;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

DailyCheck check_on(const std::string& day, bool passed) {
  return {.checked_on = day,
          .gain = MeasuredValue{.value = 0.5, .ci95 = {0.4, 0.6}},
          .passed = passed};
}

class DailyCheckInAProfile : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(DailyCheckInAProfile, StandsBehindTheOthersAndNothingElseChanges) {
  DeviceProfile profile = sound_profile();
  const fs::path file = write_device_profile(profile, folder_.path());
  // The test adds a comment to a part, which the program itself does not keep.
  std::string text = text_of(file);
  const std::string key = "\"rotation\":";
  text.replace(text.find(key), key.size(), "\"comment\": \"screws tightened\", " + key);
  write_text(file, text);
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);

  const DailyCheck failed = check_on("2999-01-01", false);
  add_daily_check(file, failed);
  profile.checks.push_back(failed);
  EXPECT_EQ(read_device_profile(file), profile);
  EXPECT_NE(text_of(file).find("screws tightened"), std::string::npos);
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  const DailyCheck passed = check_on("2999-01-01", true);
  add_daily_check(file, passed);
  profile.checks.push_back(passed);
  EXPECT_EQ(read_device_profile(file), profile) << "two of one day";
}

TEST_F(DailyCheckInAProfile, TheFirstStandsBeforeTheSignature) {
  DeviceProfile profile = sound_profile();
  profile.checks.clear();
  const fs::path file = write_device_profile(profile, folder_.path());
  add_daily_check(file, check_on("2999-01-01", true));
  profile.checks.push_back(check_on("2999-01-01", true));
  EXPECT_EQ(text_of(file), device_profile_text(profile)) << "as if written in one go";
}

TEST_F(DailyCheckInAProfile, WhatWouldBreakTheProfileChangesNothing) {
  const fs::path file = write_device_profile(sound_profile(), folder_.path());
  const std::string before = text_of(file);
  EXPECT_THROW(add_daily_check(file, check_on("2001-01-01", true)), core::Error)
      << "before the measurement";
  EXPECT_THROW(add_daily_check(folder_.path() / "none.device.json", {}), core::Error);
  EXPECT_EQ(text_of(file), before);
  std::string edited = before;
  edited.replace(edited.find("2026"), 4, "2025");
  write_text(file, edited);
  EXPECT_THROW(add_daily_check(file, check_on("2999-01-01", true)), core::Error)
      << "a check makes no edited profile sound";
  EXPECT_EQ(text_of(file), edited);
}

TEST_F(DailyCheckInAProfile, WhatADeadProgramLeftIsInNobodysWay) {
  const fs::path file = write_device_profile(sound_profile(), folder_.path());
  fs::path left = file;
  left += ".new";
  write_text(left, "{\"half");
  add_daily_check(file, check_on("2999-01-01", true));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(read_device_profile(file).checks.back(), check_on("2999-01-01", true));
}

TEST_F(DailyCheckInAProfile, ThroughALinkTheFileItselfIsChanged) {
  const fs::path file = write_device_profile(sound_profile(), folder_.path() / "real");
  const fs::path link = folder_.path() / "link.device.json";
  fs::create_symlink(file, link);
  add_daily_check(link, check_on("2999-01-01", true));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read_device_profile(file).checks.back(), check_on("2999-01-01", true));
}

TEST_F(DailyCheckInAProfile, TwoAtOnceAreBothThere) {
  const fs::path file = write_device_profile(sound_profile(), folder_.path());
  const std::size_t before = sound_profile().checks.size();
  constexpr int kThreads = 4, kEach = 5;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; ++i) {
      threads.emplace_back([&] {
        for (int n = 0; n < kEach; ++n) add_daily_check(file, check_on("2999-01-01", true));
      });
    }
  }
  EXPECT_EQ(read_device_profile(file).checks.size(),
            before + static_cast<std::size_t>(kThreads * kEach));
}

}  // namespace profile_writer_test
}  // namespace jnd::experiments
