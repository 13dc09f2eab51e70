#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "app/commands/command_fixture.h"
#include "app/tiny_study.h"

namespace jnd::app {
namespace sound_command_test {

using nlohmann::json;
using test_support::ProgramOutcome;

/// Imitates a machine whose only output of sound is a file.
class SoundCommandTest : public CommandTest {
 protected:
  SoundCommandTest() {
    write_file(path("alsa.conf"),
               "pcm.to_a_file {\n  type file\n  slave.pcm { type null }\n  file \"" +
                   path("played").string() +
                   "\"\n  format raw\n"
                   "  hint { show on description \"what a test reads\" }\n}\n");
    options_.environment.emplace_back("ALSA_CONFIG_PATH", path("alsa.conf").string());
    options_.environment.emplace_back("JND_SOUND_FILE", path("sound.json").string());
  }
};

TEST_F(SoundCommandTest, ListsOutputsAndWhatIsKnownOfThem) {
  ProgramOutcome listed = jnd({"sound"});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_NE(listed.out.find("to_a_file\n  what a test reads\n  not calibrated\n"),
            std::string::npos)
      << listed.out;
  EXPECT_NE(listed.out.find("default  (sessions use it)"), std::string::npos) << listed.out;

  EXPECT_EQ(jnd({"sound", "--output", "to_a_file", "--keep"}).exit_code, 0);
  const ProgramOutcome kept =
      jnd({"sound", "--output", "to_a_file", "--calibrate", "62.5", "--level-dbfs", "-40"});
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_NE(kept.out.find("so a sine of full scale is 102.5 dB SPL"), std::string::npos);
  const json all = json::parse(jnd({"sound", "--json"}).out);
  const auto found = std::find_if(all.begin(), all.end(),
                                  [](const json& one) { return one["name"] == "to_a_file"; });
  ASSERT_NE(found, all.end());
  EXPECT_EQ((*found)["is_chosen"], true);
  EXPECT_EQ((*found)["full_scale_db_spl"], 102.5);
}

TEST_F(SoundCommandTest, PlaysAndCountsGaps) {
  const ProgramOutcome played = jnd({"sound", "--play", "both", "--output", "to_a_file",
                                     "--level-dbfs", "-50", "--seconds", "1.2", "--json"});
  EXPECT_EQ(played.exit_code, 0) << played.err;
  EXPECT_NE(played.err.find("-50.0 dB re full scale, not calibrated"), std::string::npos)
      << played.err;
  const json told = json::parse(played.out);
  EXPECT_EQ(told["num_underruns"], 0);
  EXPECT_EQ(told["num_limited"], 0);
  EXPECT_GT(told["num_frames"].get<std::int64_t>(), 24000);
  EXPECT_GT(std::filesystem::file_size(path("played")), 24000U * 8U);
}

TEST_F(SoundCommandTest, ShowsTheLevelAtTheEarWhereItIsKnown) {
  (void)jnd({"sound", "--output", "to_a_file", "--calibrate", "60", "--level-dbfs", "-40"});
  const ProgramOutcome played = jnd({"sound", "--play", "noise", "--output", "to_a_file",
                                     "--level-db-spl", "45", "--seconds", "0.2"});
  EXPECT_EQ(played.exit_code, 0) << played.err;
  EXPECT_NE(played.err.find("-55.0 dB re full scale, 45.0 dB SPL"), std::string::npos)
      << played.err;
  EXPECT_NE(played.out.find(" 0 gaps"), std::string::npos) << played.out;
}

TEST_F(SoundCommandTest, PlaysWhatAStudyHas) {
  write_file(path("heard.json"),
             replaced(kTinyStudy, "\"stages\": [",
                      R"("masking_noise": {"kind": "pink", "level_dbfs": -45}, "stages": [)"));
  const ProgramOutcome played =
      jnd({"sound", "--sound-of", "heard.json", "--output", "to_a_file", "--seconds", "0.2"});
  EXPECT_EQ(played.exit_code, 0) << played.err;
  EXPECT_NE(played.err.find("-45.0 dB"), std::string::npos) << played.err;
  write_file(path("silent.json"), kTinyStudy);
  EXPECT_EQ(jnd({"sound", "--sound-of", "silent.json"}).exit_code, 2);
}

TEST_F(SoundCommandTest, IsNeverTooLoud) {
  EXPECT_EQ(jnd({"sound", "--play", "noise", "--level-dbfs", "-14"}).exit_code, 2);
  EXPECT_EQ(jnd({"sound", "--play", "noise", "--level-db-spl", "86"}).exit_code, 2);
  (void)jnd({"sound", "--output", "to_a_file", "--calibrate", "80", "--level-dbfs", "-40"});
  const ProgramOutcome loud = jnd({"sound", "--play", "noise", "--output", "to_a_file",
                                   "--level-dbfs", "-30", "--seconds", "0.2"});
  EXPECT_EQ(loud.exit_code, 3) << "90 dB SPL";
  EXPECT_NE(loud.err.find("expected at most 85 dB SPL"), std::string::npos) << loud.err;
}

TEST_F(SoundCommandTest, SaysWhatIsMissing) {
  const ProgramOutcome nowhere =
      jnd({"sound", "--play", "noise", "--output", "nowhere", "--seconds", "0.2"});
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_NE(nowhere.err.find("sound output nowhere: expected"), std::string::npos);
  EXPECT_EQ(jnd({"sound", "--calibrate", "60"}).exit_code, 2);
  EXPECT_EQ(jnd({"sound", "--keep"}).exit_code, 2);
}

TEST_F(SoundCommandTest, ASimulatedParticipantHearsNothing) {
  write_file(path("heard.json"),
             replaced(kTinyStudy, "\"stages\": [",
                      R"("masking_noise": {"kind": "pink", "level_dbfs": -45, "required": true},
                         "stages": [)"));
  const ProgramOutcome run =
      jnd({"run", "heard.json", "--study", "a.study", "--participant", "P01", "--headless"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("played")));
  for (const core::EventRow& event : opened("a.study").events(1)) {
    EXPECT_FALSE(event.kind.starts_with("sound")) << event.kind;
  }
  const ProgramOutcome off = jnd(
      {"run", "heard.json", "--study", "b.study", "--participant", "P01", "--sound", "off"});
  EXPECT_EQ(off.exit_code, 2);
  EXPECT_NE(off.err.find("requires its sound"), std::string::npos) << off.err;
}

}  // namespace sound_command_test
}  // namespace jnd::app
