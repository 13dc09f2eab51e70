// What the window shows of somebody's table equals what its printed command gives.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/curves/fit_words.h"
#include "app/json_document.h"
#include "app/operator/open_data.h"
#include "support/files.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace open_data_command_test {

using test_support::ProgramOutcome;

class OpenDataCommand : public ::testing::Test {
 protected:
  /// Runs the command as somebody pastes it into a shell.
  [[nodiscard]] ProgramOutcome in_a_shell(const std::string& command) const {
    const std::string programs =
        test_support::program_file().parent_path().string() + ":/usr/bin:/bin";
    return test_support::run_program(
        {"-c", command},
        {.folder = "/", .environment = {{"PATH", programs}}, .program = "/bin/sh"});
  }
  const DataView& open(const std::string& name, const std::string& text) {
    test_support::write_file(folder_.path() / name, text);
    data_.open(folder_.path() / name);
    data_.wait();
    return data_.view();
  }

  test_support::TemporaryFolder folder_;
  OpenData data_;
};

std::string shown(const nlohmann::json& value) { return number(value.get<double>()); }

/// Compares what a window says of every group with the command's document.
void expect_same(const DataResults& results, const nlohmann::json& fits) {
  ASSERT_EQ(results.groups.size(), fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const DataGroup& group = results.groups[i];
    const nlohmann::json& fit = fits[i];
    EXPECT_EQ(group.num_trials, fit["num_trials"]);
    EXPECT_EQ(group.location.value, shown(fit["location"]));
    EXPECT_EQ(group.scale.value, shown(fit["scale"]));
    EXPECT_EQ(group.deviance, shown(fit["deviance"]));
    ASSERT_EQ(group.thresholds.size(), fit["thresholds"].size());
    for (std::size_t k = 0; k < group.thresholds.size(); ++k) {
      const nlohmann::json& threshold = fit["thresholds"][k];
      EXPECT_EQ(group.thresholds[k].value, shown(threshold["value"]));
      EXPECT_EQ(group.thresholds[k].interval,
                shown(threshold["ci95"][0]) + " to " + shown(threshold["ci95"][1]));
    }
  }
}

constexpr char kOrder[] =
    "condition,delay_ms,num_first,num_asked\nlight,-90,2,40\nlight,-60,5,40\nlight,-30,12,40\n"
    "light,0,20,40\nlight,30,30,40\nlight,60,36,40\nlight,90,38,40\nsound,-90,1,40\n"
    "sound,-60,2,40\nsound,-30,5,40\nsound,0,12,40\nsound,30,22,40\nsound,60,32,40\n"
    "sound,90,37,40\n";

TEST_F(OpenDataCommand, PrintsTheNumbersOfTheWindow) {
  const DataView& view = open("order of two.csv", kOrder);
  ASSERT_NE(view.results, nullptr) << view.problem << view.fit_problem;
  ASSERT_NE(view.comparison, nullptr);
  const ProgramOutcome outcome = in_a_shell(view.command + " --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << view.command;
  const auto json = document(outcome.out);
  expect_same(*view.results, json["fits"]);
  const auto& contrast = json["comparison"]["contrasts"][0];
  ASSERT_EQ(view.comparison->contrasts.size(), 1U);
  EXPECT_EQ(view.comparison->contrasts[0].difference.value,
            shown(contrast["difference"]["value"]))
      << contrast.dump();
  // The text for people has the same digits.
  const std::string text = in_a_shell(view.command).out;
  for (const DataGroup& group : view.results->groups) {
    for (const std::string& part : {group.pse.value, group.pse.interval, group.jnd.interval}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
  }
  for (const DataVerdict& verdict : view.comparison->verdicts) {
    const std::string found = verdict.sentence.substr(verdict.sentence.find("chi-squared"));
    EXPECT_NE(text.find(found), std::string::npos) << found << "\n" << text;
  }
}

TEST_F(OpenDataCommand, PrintsThemOfAnotherCurveAndOfSomeRows) {
  CurveRequest request = open("a.csv", kOrder).request;
  request.family = "logistic";
  request.lapse = "free";
  request.at = {0.5, 0.75};
  request.where = {"condition=sound"};
  data_.ask(request);
  data_.wait();
  const DataView& view = data_.view();
  ASSERT_NE(view.results, nullptr) << view.fit_problem;
  const ProgramOutcome outcome = in_a_shell(view.command + " --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << view.command;
  expect_same(*view.results, document(outcome.out)["fits"]);
}

TEST_F(OpenDataCommand, WritesTheTableThatTheWindowSaves) {
  const DataView& view = open("a.csv", kOrder);
  data_.save_table(folder_.path() / "fits.csv");
  data_.wait();
  ASSERT_TRUE(view.outcome.ok) << view.outcome.sentence;
  // A table has no room for a comparison.
  std::string command = view.command;
  const std::string compare = " --compare";
  if (const std::size_t at = command.find(compare); at != std::string::npos) {
    command.erase(at, compare.size());
  }
  EXPECT_EQ(in_a_shell(command + " --as-csv").out,
            test_support::read_file(folder_.path() / "fits.csv"));
}

TEST_F(OpenDataCommand, DrawsThePictureThatTheWindowSaves) {
  if (in_a_shell("command -v gnuplot").exit_code != 0) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  const DataView& view = open("a.csv", kOrder);
  data_.save_picture(folder_.path() / "window.svg");
  data_.wait();
  ASSERT_TRUE(view.outcome.ok) << view.outcome.sentence;
  const std::filesystem::path file = folder_.path() / "command.svg";
  EXPECT_EQ(in_a_shell(view.command + " --figure " + file.string()).exit_code, 0);
  EXPECT_TRUE(test_support::read_file(file) ==
              test_support::read_file(folder_.path() / "window.svg"));
}

}  // namespace open_data_command_test
}  // namespace jnd::app
