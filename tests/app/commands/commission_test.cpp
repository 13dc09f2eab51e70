#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "support/program.h"

namespace jnd::app {
namespace commission_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class CommissionCommandTest : public CommandTest {
 protected:
  /// Runs the program with the executables of `programs` alone, and with no profiles but those
  /// of the test.
  ProgramOutcome jnd(const std::vector<std::string>& arguments,
                     const std::string& programs = "/nowhere") {
    return test_support::run_program(
        arguments, {.folder = temporary_.path(),
                    .environment = {{"PATH", programs},
                                    {"JND_PROFILE_PATH", ""},
                                    {"XDG_CONFIG_HOME", path("config").string()}}});
  }
};

TEST_F(CommissionCommandTest, WritesAReportBesideTheProfile) {
  const ProgramOutcome outcome = jnd({"commission", "twin:seed=3", "--operator", "A. Person"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(path("twin_seed_3.device.json")));
  const std::string html = read_file(path("twin_seed_3.report/report.html"));
  EXPECT_NE(html.find("SIMULATED device"), std::string::npos);
  EXPECT_NE(html.find("by A. Person"), std::string::npos);
  EXPECT_EQ(html.find(temporary_.path().string()), std::string::npos)
      << "a path of the machine";
  EXPECT_NE(outcome.out.find("twin_seed_3.report/report.html"), std::string::npos);
  EXPECT_NE(outcome.err.find("jnd: neither chromium nor wkhtmltopdf"), std::string::npos);
}

TEST_F(CommissionCommandTest, AReportOfARecordNeedsNoDevice) {
  ASSERT_EQ(jnd({"commission", "twin:seed=3", "--only", "noise,frame"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(path("twin_seed_3.report"))) << "there is no profile yet";
  // The report is made without looking up the device's name in the registry.
  fs::rename(path("twin_seed_3.commissioning.jsonl"), path("moved.jsonl"));
  ProgramOutcome outcome = jnd({"report", "--commissioning", "moved.jsonl", "--out", "first"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(read_file(path("first/report.html"))
                .find("Not measured: homing, force, delay, stability."),
            std::string::npos);

  outcome = jnd({"commission", "twin:seed=3", "--record", "moved.jsonl", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(path(document(outcome.out).at("report").get<std::string>())));
  outcome = jnd({"report", "--commissioning", "moved.jsonl", "--out", "second", "--operator",
                 "B. Other", "--json"},
                "/usr/bin");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json told = document(outcome.out);
  ASSERT_EQ(told.at("figures").size(), 5U);
  if (fs::exists("/usr/bin/gnuplot")) {
    for (const nlohmann::json& figure : told.at("figures")) {
      EXPECT_TRUE(figure.at("drawn").get<bool>()) << figure;
    }
  }
  const std::string html = read_file(path("second/report.html"));
  EXPECT_NE(html.find("The profile twin_seed_3.device.json holds until"), std::string::npos)
      << "found beside the record";
  EXPECT_NE(html.find("by B. Other"), std::string::npos);
}

TEST_F(CommissionCommandTest, AReportIsOfAStudyOrOfADevice) {
  ASSERT_EQ(jnd({"commission", "twin:seed=3", "--only", "noise"}).exit_code, 0);
  const std::string record = "twin_seed_3.commissioning.jsonl";
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"report", "--out", "a"},
           {"report", ".", "--commissioning", record, "--out", "a"},
           {"report", "--commissioning", record, "--pilot", "--out", "a"},
           {"report", ".", "--operator", "A. Person", "--out", "a"},
           {"report", "--commissioning", "none.jsonl", "--out", "a"}}) {
    EXPECT_EQ(jnd(wrong).exit_code, 2) << wrong.at(1);
    EXPECT_FALSE(fs::exists(path("a")));
  }
}

TEST_F(CommissionCommandTest, AStudyOnItHasBothCommandedAndDeliveredInItsReport) {
  const std::string device = "twin:gain=0.9,damping_n_s_per_m=2.4,friction_n=0.2";
  const std::vector<std::string> simulate = {
      "simulate", "viscosity_discrimination", "--participants", "2", "--device", device,
      "--fast"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = simulate;
    words.insert(words.end(), more.begin(), more.end());
    return jnd(words);
  };
  const std::string found = document(jnd({"commission", device, "--out", "p", "--json"}).out)
                                .at("profile")
                                .get<std::string>();
  ProgramOutcome outcome = with({"--study", "with.study", "--profile", found});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_FALSE(opened("with.study").sessions().at(1).device_profile_sha256.empty());
  outcome = jnd({"report", "with.study", "--out", "with", "--resamples", "100", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string html = read_file(path("with/report.html"));
  EXPECT_NE(html.find("Commanded and delivered"), std::string::npos);
  EXPECT_NE(html.find("SIMULATED jnd twin ideal gain=0.9"), std::string::npos);
  EXPECT_NE(html.find("; 2 sessions."), std::string::npos);
  EXPECT_NE(read_file(path("with/figures/delivered.csv"))
                .find("group_d.weber_fraction_median_person"),
            std::string::npos);
  // The report says the same as the table of results.
  outcome = jnd({"results", "with.study", "--delivered", "--resamples", "100", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("ci95_device"), std::string::npos);

  ASSERT_EQ(with({"--study", "without.study"}).exit_code, 0);
  ASSERT_EQ(
      jnd({"report", "without.study", "--out", "without", "--resamples", "100"}).exit_code, 0);
  EXPECT_EQ(read_file(path("without/report.html")).find("Commanded and delivered"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(path("without/figures/delivered.csv")));

  // The profile of another device is refused.
  ASSERT_EQ(jnd({"commission", "twin:seed=3"}).exit_code, 0);
  outcome = with({"--study", "other.study", "--profile", "twin_seed_3.device.json"});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_FALSE(fs::exists(path("other.study")));
  outcome = jnd({"demo", "--fast", "--out", "d", "--device", device, "--profile",
                 "twin_seed_3.device.json"});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("expected the profile of the device that is used"),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(path("d")));
}

}  // namespace commission_test
}  // namespace jnd::app
