// Uses the example driver as if it were a robot: for the program, this is a device that could
// hurt somebody.
#include <signal.h>

#include <optional>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "device/plugin/plugin_fixture.h"
#include "experiments/device_profile/device_profile_table.h"
#include "experiments/device_profile/profile_reader.h"
#include "support/files.h"
#include "support/wide_profile.h"

namespace jnd::app {
namespace profile_command_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

constexpr const char* kModel = "example hand";

class ProfileCommandTest : public CommandTest {
 protected:
  void SetUp() override {
    (void)device::built_driver(device::example_source(), temporary_.path(), "example");
    options_.environment.emplace_back("JND_DEVICE_PATH", temporary_.path().string());
    options_.environment.emplace_back("XDG_CONFIG_HOME", path("config").string());
    options_.environment.emplace_back("JND_PROFILE_PATH", path("profiles").string());
    test_support::write_file(path("force.json"), study_of(R"json(
      {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
       "medium": "viscous", "viscosity_pa_s": [2, 4], "repetitions": 1,
       "free_space_between_s": 0, "instruction": {"en": "Say."},
       "question": {"en": "How strong?"}, "expected_trial_s": 5})json"));
    test_support::write_file(path("free.json"), study_of(R"json(
      {"kind": "explore", "name": "free", "instruction": {"en": "Move."},
       "media": [{"medium": "free_space", "duration_s": 0.2}]})json"));
  }
  static std::string study_of(const std::string& stage) {
    return R"json({"format": 1, "name": "s", "languages": ["en"], "title": {"en": "S"},
                   "authors": ["A"], "device": {"min_contact_points": 1, "max_missed_ratio": 1},
                   "stages": [)json" +
           stage + "]}";
  }
  /// Returns the words of a session in real time with somebody beside the device, as for a
  /// robot.
  [[nodiscard]] static std::vector<std::string> run_words(
      const std::string& study, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"run",
                                      study,
                                      "--study",
                                      "s.study",
                                      "--participant",
                                      "P01",
                                      "--seed",
                                      "7",
                                      "--headless",
                                      "--arm",
                                      "--allow-no-realtime",
                                      "--device",
                                      "plugin:example:real"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  fs::path measured() const {
    return test_support::write_wide_profile(path("profiles"), kModel, "simulated");
  }
  /// Resumes the session until it is complete, because a machine that is too busy for real time
  /// interrupts it.
  void finish(ProgramOutcome outcome) const {
    for (int i = 0; i < 20 && outcome.exit_code != 0; ++i) {
      ASSERT_NE(outcome.err.find("jnd resume s.study"), std::string::npos) << outcome.err;
      outcome = jnd({"resume", "s.study", "--headless", "--arm"});
    }
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(ProfileCommandTest, ARealDeviceWithoutAProfileIsRefusedBeforeAnythingIsStored) {
  const ProgramOutcome run = jnd(run_words("force.json"));
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(sentence_flaw(run.err, {"expected a profile of `example hand`",
                                    "found none; measure it with `jnd commission "
                                    "plugin:example:real`"}),
            "");
  EXPECT_FALSE(fs::exists(path("s.study")));
}

TEST_F(ProfileCommandTest, AStudyOfFreeSpaceAloneRunsWithoutOne) {
  finish(jnd(run_words("free.json")));
  EXPECT_TRUE(opened("s.study").completed(1));
  EXPECT_EQ(opened("s.study").session(1).device_profile_sha256, "");
}

TEST_F(ProfileCommandTest, ASessionKeepsTheProfileThatItRanBy) {
  const fs::path file = measured();
  finish(jnd(run_words("force.json")));
  ASSERT_TRUE(opened("s.study").completed(1));
  const core::StudyStore store = opened("s.study");
  const std::string hash = store.session(1).device_profile_sha256;
  EXPECT_EQ(store.device_profile(hash).text, test_support::read_file(file));
  EXPECT_EQ(jnd({"verify", "s.study"}).exit_code, 0);
  ASSERT_EQ(jnd({"export", "csv", "s.study", "--out", "csv"}).exit_code, 0);
  EXPECT_EQ(test_support::read_file(path("csv") / "device_profiles" / (hash + ".device.json")),
            test_support::read_file(file));
  ASSERT_EQ(jnd({"backup", "s.study", "--to", "copy.study"}).exit_code, 0);
  EXPECT_EQ(opened("copy.study").device_profile(hash).sha256, hash);
}

TEST_F(ProfileCommandTest, OneThatHasEndedIsForeignOrWasEditedIsRefused) {
  experiments::DeviceProfile profile = test_support::wide_profile(kModel, "simulated");
  profile.valid_until = "2020-12-31";
  profile.measured_on = "2020-01-01";
  profile.checks.clear();
  const fs::path ended = experiments::write_device_profile(profile, path("profiles"));
  const ProgramOutcome found = jnd(run_words("force.json"));
  EXPECT_EQ(found.exit_code, 3) << found.err;
  EXPECT_EQ(sentence_flaw(found.err, {"found that it ended on 2020-12-31"}), "");
  const ProgramOutcome given = jnd(run_words("force.json", {"--profile", ended.string()}));
  EXPECT_EQ(given.exit_code, 1) << given.err;
  EXPECT_EQ(sentence_flaw(given.err, {"found that it ended on 2020-12-31"}), "");

  const fs::path foreign = test_support::write_wide_profile(path("elsewhere"), "omega", "3");
  const ProgramOutcome other = jnd(run_words("force.json", {"--profile", foreign.string()}));
  EXPECT_EQ(other.exit_code, 1) << other.err;
  EXPECT_EQ(sentence_flaw(other.err, {"found that of `omega` 3"}), "");

  const fs::path edited = test_support::write_wide_profile(path("edited"), kModel, "simulated");
  test_support::write_file(edited, replaced(test_support::read_file(edited), "\"value\": 0.97,",
                                            "\"value\": 0.98,"));
  const ProgramOutcome changed = jnd(run_words("force.json", {"--profile", edited.string()}));
  EXPECT_EQ(changed.exit_code, 1) << changed.err;
  EXPECT_EQ(sentence_flaw(changed.err, {"/force: expected `force` as measured"}), "");
  EXPECT_FALSE(fs::exists(path("s.study")));
}

TEST_F(ProfileCommandTest, ASessionIsResumedByTheSameProfileAlone) {
  const fs::path file = measured();
  std::vector<std::string> words = run_words("force.json", {"--acknowledge"});
  RunningProgram session(words, options_);
  ASSERT_TRUE(session.read_line());
  session.send_signal(SIGKILL);
  (void)session.wait();

  const std::string text = test_support::read_file(file);
  test_support::write_file(
      file, replaced(text, "\"max_total_force_n\": 30.0", "\"max_total_force_n\": 5.0"));
  const std::vector<std::string> resume = {"resume", "s.study", "--headless", "--arm"};
  const ProgramOutcome narrower = jnd(resume);
  EXPECT_EQ(narrower.exit_code, 1) << narrower.err;
  EXPECT_EQ(sentence_flaw(narrower.err, {"session 1: expected the profile that it was begun "
                                         "with, measured on 2026-11-20",
                                         "with other numbers"}),
            "");
  fs::remove(file);
  finish(jnd(resume));
  EXPECT_TRUE(opened("s.study").completed(1)) << "what is kept counts";
}

TEST_F(ProfileCommandTest, APlanComparesTheStimuliWithWhatWasMeasured) {
  experiments::DeviceProfile profile = test_support::wide_profile("lumped");
  profile.limits.max_total_force_n = 6.0;
  profile.stability->viscosity_pa_s = {.value = 3.0, .is_beyond_ladder = false};
  const fs::path file = experiments::write_device_profile(profile, path("mine"));
  ASSERT_EQ(jnd({"plan", "force.json"}).exit_code, 0) << "by what the device says";
  const ProgramOutcome plan = jnd({"plan", "force.json", "--profile", file.string(), "--json"});
  EXPECT_EQ(plan.exit_code, 1);
  const auto json = document(plan.out);
  EXPECT_EQ(json["limits"]["max_total_force_n"], 6.0);
  EXPECT_EQ(json["device_profile"]["measured_on"], "2026-11-20");
  EXPECT_NE(plan.err.find("expected stimuli that `lumped` renders stably at 1000 Hz, as "
                          "measured on 2026-11-20 with a phantom of 0.2 kg (up to 3 Pa s and "
                          "1000000 N/m or more), found 1 of 2 beyond"),
            std::string::npos)
      << plan.err;
  const ProgramOutcome validated =
      jnd({"validate", "force.json", "--device", "lumped", "--profile", file.string()});
  EXPECT_EQ(validated.exit_code, 1);
  EXPECT_NE(
      validated.out.find("expected a stimulus that `lumped` renders stably at 1000 Hz, as "
                         "measured on 2026-11-20"),
      std::string::npos)
      << validated.out;
}

TEST_F(ProfileCommandTest, DevicesTellsWhatWasMeasured) {
  const auto told = [this] {
    return document(jnd({"devices", "--device", "plugin:example:real", "--json"}).out);
  };
  EXPECT_TRUE(told()["profile"].is_null());
  const fs::path file = measured();
  // The example says that it is simulated, whatever it is used as.
  EXPECT_EQ(told()["profile"]["file"], file.string());
  EXPECT_EQ(told()["profile"]["measured_on"], "2026-11-20");
}

TEST_F(ProfileCommandTest, ValidateAndSchemaKnowProfiles) {
  const fs::path file = measured();
  const ProgramOutcome sound = jnd({"validate", file.string()});
  EXPECT_EQ(sound.exit_code, 0) << sound.out << sound.err;
  EXPECT_NE(sound.out.find(
                "no problem; `example hand` simulated, measured on 2026-11-20, valid until "
                "2999-12-31"),
            std::string::npos)
      << sound.out;
  test_support::write_file(file,
                           replaced(test_support::read_file(file), "\"gain\"", "\"gian\""));
  const ProgramOutcome broken = jnd({"validate", file.string(), "--json"});
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_EQ(document(broken.out)["problems"][0]["pointer"], "/force/gian");
  EXPECT_EQ(jnd({"schema", "--device-profile"}).out, experiments::device_profile_schema());
  EXPECT_EQ(jnd({"schema", "--device-profile", "--markdown"}).out,
            experiments::device_profile_reference());
}

}  // namespace profile_command_test
}  // namespace jnd::app
