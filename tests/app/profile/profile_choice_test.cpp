#include "app/profile/profile_choice.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "app/profile/known_profile.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "core/error.h"
#include "core/storage/study_store.h"
#include "experiments/device_profile/profile_writer.h"
#include "experiments/protocol/study_reader.h"
#include "support/files.h"
#include "support/sound_profile.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace profile_choice_test {

namespace fs = std::filesystem;
using experiments::DeviceProfile;
using test_support::sound_profile;

constexpr const char* kDay = "2026-11-26";

/// Returns the message that is thrown, or "" if nothing is.
std::string thrown_by(const std::function<void()>& work) {
  try {
    work();
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

class ProfileChoiceTest : public ::testing::Test {
 protected:
  /// Returns a real device as it describes itself before it is open.
  [[nodiscard]] static DeviceOfProfile device(const std::string& serial = "17",
                                              bool is_simulated = false) {
    return {.name = "plugin:wam",
            .identity = {.model = "wam", .serial = serial, .firmware = "2.1"},
            .is_simulated = is_simulated,
            .says_simulated = is_simulated};
  }
  fs::path write(const DeviceProfile& profile, const std::string& folder = "devices") const {
    return experiments::write_device_profile(profile, temporary_.path() / folder);
  }
  [[nodiscard]] std::vector<fs::path> folders() const {
    return {temporary_.path() / "other", temporary_.path() / "devices"};
  }
  [[nodiscard]] ProfileChoice choice(const DeviceOfProfile& of, const std::string& file = "") {
    return choose_profile(of, file, folders(), kDay);
  }
  [[nodiscard]] std::string refused(const fs::path& file, const DeviceOfProfile& of) {
    return thrown_by([&] { (void)choice(of, file.string()); });
  }
  static experiments::Study study(const std::string& stages, const std::string& device = "") {
    return experiments::read_study_text(
        R"json({"format": 1, "name": "s", "languages": ["en"], "title": {"en": "S"},
                "authors": ["A"], "device": {"min_contact_points": 1)json" +
            device + R"json(}, "stages": [)json" + stages + "]}",
        "s.json");
  }
  static experiments::Study free_study() {
    return study(R"json({"kind": "explore", "name": "free", "instruction": {"en": "Move."},
        "media": [{"medium": "free_space", "duration_s": 5}]})json");
  }

  test_support::TemporaryFolder temporary_;
};

TEST_F(ProfileChoiceTest, ARealDeviceHasTheOneMeasuredLast) {
  DeviceProfile first = sound_profile(), second = sound_profile(), foreign = sound_profile();
  first.checks.clear();
  second.checks.clear();
  second.measured_on = "2026-11-21";
  foreign.measured_on = "2026-11-25";
  foreign.device.serial = "18";
  foreign.checks.clear();
  write(second, "other");
  write(first);
  write(foreign);
  const ProfileChoice found = choice(device());
  ASSERT_TRUE(found.known);
  EXPECT_EQ(found.known->profile.measured_on, "2026-11-21");
  EXPECT_EQ(found.lack, "");
  ASSERT_EQ(found.remarks.size(), 1u);
  EXPECT_EQ(found.remarks.front(),
            found.known->place + ": used for `wam` 17, the one measured last of 2 that fit");
}

TEST_F(ProfileChoiceTest, OfOneMeasurementTheOneCheckedLastCounts) {
  DeviceProfile checked = sound_profile(), unchecked = sound_profile();
  unchecked.checks.clear();
  write(checked);
  write(unchecked);
  EXPECT_EQ(choice(device()).known->profile.checks.size(), 2u);
}

TEST_F(ProfileChoiceTest, OfOneDayTheOneCheckedMoreOftenCounts) {
  DeviceProfile once = sound_profile(), twice = sound_profile();
  twice.checks.push_back({.checked_on = once.checks.back().checked_on, .passed = false});
  write(once, "other");
  write(twice);
  EXPECT_FALSE(choice(device()).known) << "a copy from before does not lift a failed check";
}

TEST_F(ProfileChoiceTest, ADailyCheckIsAboutOneThatIsValidAlsoWhereTheLastOneFailed) {
  const auto checked = [&](const DeviceOfProfile& its, const std::string& file) {
    try {
      return profile_to_check(its, file, folders(), kDay).place;
    } catch (const core::Error& error) {
      return "refused: " + std::string(error.what());
    }
  };
  EXPECT_TRUE(checked(device(), "")
                  .starts_with("refused: --device plugin:wam: expected a "
                               "profile of `wam` 17 to check it against"));
  DeviceProfile profile = sound_profile();
  profile.checks.back().passed = false;
  const fs::path file = write(profile);
  EXPECT_EQ(checked(device(), ""), file.string());
  EXPECT_EQ(checked(device(), file.string()), file.string());
  EXPECT_EQ(checked(device("17", true), ""), file.string()) << "of a simulated one as well";
  EXPECT_NE(checked(device("18"), file.string()).find("found that of `wam` 17"),
            std::string::npos);
  profile.valid_until = "2026-11-25";
  const fs::path ended = write(profile, "ended");
  EXPECT_NE(checked(device(), ended.string()).find("found that it ended"), std::string::npos);
}

TEST_F(ProfileChoiceTest, ARealDeviceWithoutOneLacksIt) {
  const ProfileChoice none = choice(device());
  EXPECT_FALSE(none.known);
  EXPECT_EQ(none.lack,
            "--device plugin:wam: expected a profile of `wam` 17, as of every real device that "
            "is to give force, found none; measure it with `jnd commission plugin:wam`");
}

TEST_F(ProfileChoiceTest, ASimulatedDeviceHasNoneUnlessItIsGiven) {
  const fs::path file = write(sound_profile());
  EXPECT_FALSE(choice(device("17", true)).known);
  EXPECT_EQ(choice(device("17", true)).lack, "");
  EXPECT_TRUE(choice(device("17", true), file.string()).known);
}

TEST_F(ProfileChoiceTest, AnotherModelOrSerialIsRefused) {
  const fs::path file = write(sound_profile());
  EXPECT_EQ(refused(file, device("3")),
            file.string() +
                ": expected the profile of the device that is used, `wam` 3, found that of "
                "`wam` 17; choose its own, or measure it with `jnd commission`");
  DeviceOfProfile omega = device();
  omega.identity.model = "omega";
  EXPECT_NE(refused(file, omega).find("`omega` 17, found that of `wam` 17"), std::string::npos);
  EXPECT_EQ(refused(file, device()), "");
}

TEST_F(ProfileChoiceTest, OneThatHasEndedIsRefusedTheDayAfter) {
  DeviceProfile profile = sound_profile();
  profile.valid_until = "2026-11-25";
  const fs::path file = write(profile);
  EXPECT_EQ(refused(file, device()),
            file.string() +
                ": expected a profile that is valid today (2026-11-26), found that it ended on "
                "2026-11-25; measure the device again with `jnd commission`");
  EXPECT_EQ(choice(device()).lack, refused(file, device())) << "also where it is found";
  EXPECT_EQ(outdated_words(read_known_profile(file), "2026-11-25"), "") << "its last day";
}

TEST_F(ProfileChoiceTest, OneWhoseLastCheckFailedIsRefused) {
  DeviceProfile profile = sound_profile();
  profile.checks.back().passed = false;
  const std::string words = refused(write(profile), device());
  EXPECT_NE(words.find("expected a device whose last daily check was passed, found that of "
                       "2026-11-25 failed"),
            std::string::npos)
      << words;
  profile.checks.push_back({.checked_on = "2026-11-26", .passed = true});
  EXPECT_EQ(refused(write(profile), device()), "");
}

TEST_F(ProfileChoiceTest, OneOfASimulatedDeviceIsNoneOfARealOne) {
  DeviceProfile profile = sound_profile();
  profile.simulated = true;
  const fs::path file = write(profile);
  EXPECT_NE(refused(file, device()).find("found one of a SIMULATED device"), std::string::npos);
  EXPECT_FALSE(choice(device()).known);
  EXPECT_NE(choice(device()).lack, "");
  EXPECT_TRUE(choice(device("17", true), file.string()).known);
}

TEST_F(ProfileChoiceTest, ASimulationThatIsOpenedAsRealNeedsAProfileAndItsOwnFits) {
  DeviceOfProfile rehearsed = device();
  rehearsed.says_simulated = true;
  EXPECT_NE(choice(rehearsed).lack, "");
  DeviceProfile profile = sound_profile();
  profile.simulated = true;
  write(profile);
  EXPECT_TRUE(choice(rehearsed).known);
  EXPECT_EQ(choice(rehearsed).lack, "");
}

TEST_F(ProfileChoiceTest, AnEditedOneIsRefusedWithThePartThatWasChanged) {
  const fs::path file = write(sound_profile());
  test_support::write_file(
      file, replaced(test_support::read_file(file), "\"value\": 0.97,", "\"value\": 0.98,"));
  const std::string words = refused(file, device());
  EXPECT_NE(words.find(": /force: expected `force` as measured, found a change since then"),
            std::string::npos)
      << words;
  const ProfileChoice found = choice(device());
  EXPECT_FALSE(found.known) << "nor is it found";
  EXPECT_NE(found.lack, "");
  ASSERT_EQ(found.remarks.size(), 1u);
  EXPECT_EQ(found.remarks.front(), words);
}

TEST_F(ProfileChoiceTest, ADeviceThatTellsItsSerialLaterHasTheOnlyOneOfItsModel) {
  const fs::path file = write(sound_profile());
  EXPECT_TRUE(choice(device("")).known);
  EXPECT_EQ(foreign_words(*choice(device("")).known, device("").identity, false, true).empty(),
            false)
      << "once it is open it has to be the one";
  DeviceProfile other = sound_profile();
  other.device.serial = "18";
  write(other);
  EXPECT_FALSE(choice(device("")).known);
  EXPECT_NE(choice(device("")).lack.find("say which with --profile FILE"), std::string::npos);
  EXPECT_TRUE(choice(device(""), file.string()).known);
}

TEST_F(ProfileChoiceTest, EverySentenceIsOne) {
  DeviceProfile profile = sound_profile();
  profile.valid_until = "2026-11-25";
  const fs::path ended = write(profile);
  for (const std::string& words :
       {choice(device("1")).lack, refused(ended, device()), refused(ended, device("1"))}) {
    EXPECT_EQ(sentence_flaw("jnd: " + words + "\n"), "") << words;
  }
}

TEST_F(ProfileChoiceTest, AStudyOfFreeSpaceAloneAsksForNoForce) {
  EXPECT_FALSE(asks_for_force(free_study()));
  EXPECT_FALSE(asks_for_force(study(
      R"json({"kind": "break", "name": "b", "instruction": {"en": "R."}, "duration_s": 1})json")));
  EXPECT_TRUE(asks_for_force(experiments::read_study_text(kTinyStudy, "x")));
  EXPECT_TRUE(asks_for_force(
      study(R"json({"kind": "explore", "name": "f", "instruction": {"en": "Move."},
        "media": [{"medium": "free_space", "duration_s": 5},
                  {"medium": "viscous", "viscosity_pa_s": 1, "duration_s": 5}]})json")));
  EXPECT_TRUE(asks_for_force(
      study(R"json({"kind": "training", "name": "t", "instruction": {"en": "Move."},
        "examples": [{"medium": "water", "scale": 1, "duration_s": 5}]})json")));
  EXPECT_TRUE(asks_for_force(
      study(R"json({"kind": "explore", "name": "free", "instruction": {"en": "Move."},
        "media": [{"medium": "free_space", "duration_s": 5}]})json",
            R"json(, "immersion": {"depth_m": 0.3, "wall_stiffness_n_per_m": 1000})json")))
      << "a floor is felt in free space, too";
}

TEST_F(ProfileChoiceTest, WithoutAProfileOnlyWhatAsksForNoForceIsBegun) {
  const experiments::Study tiny = experiments::read_study_text(kTinyStudy, "x");
  const ProfileChoice none = choice(device());
  EXPECT_EQ(refused_words(device(), none, tiny), none.lack);
  EXPECT_EQ(refused_words(device(), none, free_study()), "");
  EXPECT_EQ(refused_words(device("17", true), {}, tiny), "");
  write(sound_profile());
  EXPECT_EQ(refused_words(device(), choice(device()), tiny), "");
}

TEST_F(ProfileChoiceTest, TheFoldersAreThoseOfTheEnvironmentAndTheUsersOwn) {
  const char* before = std::getenv("XDG_CONFIG_HOME");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("XDG_CONFIG_HOME", "/config", 1);
  ::setenv("JND_PROFILE_PATH", "/a::/b", 1);
  const std::vector<fs::path> found = profile_folders();
  ::unsetenv("JND_PROFILE_PATH");
  const std::vector<fs::path> own = profile_folders();
  kept.empty() ? ::unsetenv("XDG_CONFIG_HOME") : ::setenv("XDG_CONFIG_HOME", kept.c_str(), 1);
  EXPECT_EQ(found, (std::vector<fs::path>{"/a", "/b", "/config/jnd/devices"}));
  EXPECT_EQ(own, (std::vector<fs::path>{"/config/jnd/devices"}));
}

TEST_F(ProfileChoiceTest, SaysHowOldAProfileIs) {
  DeviceProfile profile = sound_profile();
  profile.valid_until = "2027-11-20";
  EXPECT_EQ(age_words(profile, kDay),
            "measured on 2026-11-20, 6 days ago, valid until 2027-11-20");
  EXPECT_EQ(age_words(profile, "2026-11-20"),
            "measured on 2026-11-20, today, valid until 2027-11-20");
  profile.simulated = true;
  EXPECT_EQ(age_words(profile, "2026-11-21"),
            "SIMULATED, measured on 2026-11-20, yesterday, valid until 2027-11-20");
  EXPECT_EQ(days_between("2026-02-28", "2028-03-01"), 732) << "over a leap day";
}

/// A session that was begun with the profile of a real device and is to be resumed.
class ResumedProfileTest : public ProfileChoiceTest {
 protected:
  ResumedProfileTest()
      : store_(temporary_.path() / "s.study", core::StudyStore::Mode::kCreate) {
    begin(experiments::device_profile_text(begun_with()));
  }
  [[nodiscard]] static DeviceProfile begun_with() {
    DeviceProfile profile = sound_profile();
    profile.valid_until = "2026-12-24";
    return profile;
  }
  void begin(const std::string& profile_text) {
    const std::string hash = store_.add_protocol("x.json", kTinyStudy);
    session_ = store_.add_session(
        {.participant = "P01",
         .protocol_sha256 = hash,
         .device = "plugin:wam",
         .device_profile_sha256 =
             profile_text.empty() ? "" : store_.add_device_profile(profile_text)});
  }
  [[nodiscard]] std::string words(const DeviceOfProfile& of = device(),
                                  const std::string& file = "",
                                  const std::string& on_day = kDay) const {
    return refused_resume_words(store_, store_.session(session_), study_, of, file, folders(),
                                on_day);
  }

  core::StudyStore store_;
  std::int64_t session_ = 0;
  experiments::Study study_ = experiments::read_study_text(kTinyStudy, "x");
};

TEST_F(ResumedProfileTest, GoesOnWithTheSameProfileAndWithoutAnyFile) {
  EXPECT_EQ(words(), "") << "no file is there any more: what is kept counts";
  DeviceProfile same = begun_with();
  same.comment = "seen";
  same.valid_until = "2027-01-01";
  same.checks.push_back({.checked_on = "2026-11-26", .passed = true});
  write(same);
  EXPECT_EQ(words(), "");
  EXPECT_EQ(words(device(), "", "2026-12-31"), "") << "its end was put off";
}

TEST_F(ResumedProfileTest, AnotherDeviceIsRefused) {
  EXPECT_NE(
      words(device("3"))
          .find("stored device profile: expected the profile of the device that is used, `wam` "
                "3, found that of `wam` 17"),
      std::string::npos)
      << words(device("3"));
}

TEST_F(ResumedProfileTest, AnotherMeasurementIsRefused) {
  DeviceProfile again = begun_with();
  again.measured_on = "2026-11-26";
  again.checks.clear();
  again.force.gain->value = 0.975;
  const fs::path file = write(again);
  const std::string expected = temporary_.path().string() +
                               "/s.study: session 1: expected the profile that it was begun "
                               "with, measured on 2026-11-20, found " +
                               file.string() +
                               ", measured on 2026-11-26, with other numbers; end it with "
                               "`--choose end` and begin another";
  EXPECT_EQ(words(), expected);
  EXPECT_EQ(words(device(), file.string()), expected);
}

TEST_F(ResumedProfileTest, NarrowerLimitsAreAnotherProfileToo) {
  DeviceProfile narrower = begun_with();
  narrower.limits.max_total_force_n = 5.0;
  write(narrower);
  EXPECT_NE(words().find("with other numbers"), std::string::npos) << words();
}

TEST_F(ResumedProfileTest, OneThatHasEndedIsRefused) {
  EXPECT_NE(words(device(), "", "2026-12-25").find("found that it ended on 2026-12-24"),
            std::string::npos);
  write(begun_with());
  EXPECT_NE(words(device(), "", "2026-12-25").find("found that it ended on 2026-12-24"),
            std::string::npos);
}

TEST_F(ResumedProfileTest, OneThatWasBegunWithoutAProfileGivesNoForceOnARealDevice) {
  begin("");
  EXPECT_NE(words().find("session 2: expected a session that was begun with a profile"),
            std::string::npos)
      << words();
  EXPECT_EQ(words(device("17", true)), "");
  study_ = free_study();
  EXPECT_EQ(words(), "");
}

TEST_F(ResumedProfileTest, AProfileIsNotTakenUpInTheMiddle) {
  begin("");
  const fs::path file = write(begun_with());
  EXPECT_NE(words(device("17", true), file.string()).find("expected no --profile"),
            std::string::npos);
}

}  // namespace profile_choice_test
}  // namespace jnd::app
