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
  /// With the programs of these folders alone, and no profiles but its own.
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
  // Nothing of the device's name is asked of a registry.
  fs::rename(path("twin_seed_3.commissioning.jsonl"), path("moved.jsonl"));
  ProgramOutcome outcome = jnd({"report", "--commissioning", "moved.jsonl", "--out", "first"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(read_file(path("first/report.html")).find("Not measured: force, delay."),
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

}  // namespace commission_test
}  // namespace jnd::app
