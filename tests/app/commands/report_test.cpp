#include <gtest/gtest.h>

#include <map>
#include <set>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/small_disk.h"

namespace jnd::app {
namespace report_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class ReportCommandTest : public CommandTest {
 protected:
  void SetUp() override { write_file(path("tiny.json"), kTinyStudy); }

  /// Runs the program with the executables of `programs` alone.
  ProgramOutcome jnd(const std::vector<std::string>& arguments,
                     const std::string& programs = "/nowhere") {
    return test_support::run_program(
        arguments, {.folder = temporary_.path(), .environment = {{"PATH", programs}}});
  }
  void simulate(const std::string& study, const std::string& jobs = "1",
                const std::string& file = "tiny.json") {
    const ProgramOutcome outcome =
        jnd({"simulate", file, "--participants", "2", "--study", study, "--jobs", jobs});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  ProgramOutcome report(const std::string& study, const std::string& out,
                        const std::string& programs = "/nowhere") {
    return jnd({"report", study, "--out", out, "--resamples", "100"}, programs);
  }
  /// Returns every file below a folder, by its relative path.
  [[nodiscard]] std::map<std::string, std::string> files(const std::string& name) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(path(name))) {
      if (!entry.is_regular_file()) continue;
      all[fs::relative(entry.path(), path(name)).string()] = read_file(entry.path());
    }
    return all;
  }
};

TEST_F(ReportCommandTest, WithoutGnuplotAndBrowserTablesRemainAndItIsDone) {
  simulate("a.study");
  const ProgramOutcome outcome = report("a.study", "out/of/way");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("jnd: gnuplot is not installed"), std::string::npos);
  EXPECT_NE(outcome.err.find("jnd: neither chromium nor wkhtmltopdf"), std::string::npos);
  EXPECT_NE(outcome.out.find("out/of/way/report.html"), std::string::npos) << outcome.out;
  const std::string html = read_file(path("out/of/way/report.html"));
  EXPECT_NE(html.find("SIMULATED"), std::string::npos);
  EXPECT_EQ(html.find(temporary_.path().string()), std::string::npos)
      << "a path of the machine";
}

TEST_F(ReportCommandTest, TheSameStudyGivesTheSameBytesHoweverManySessionsRanAtOnce) {
  simulate("a.study", "1");
  simulate("b.study", "2");
  ASSERT_EQ(report("a.study", "a").exit_code, 0);
  ASSERT_EQ(report("a.study", "again").exit_code, 0);
  ASSERT_EQ(report("b.study", "b").exit_code, 0);
  const auto first = files("a");
  EXPECT_GT(first.size(), 10U);
  EXPECT_EQ(first, files("again"));
  EXPECT_EQ(first, files("b"));
}

TEST_F(ReportCommandTest, EveryFigureOfAStudyWithRecordingsIsDrawnByGnuplotThatIsThere) {
  if (!fs::exists("/usr/bin/gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  // The folder holds gnuplot alone, because a browser would take seconds.
  fs::create_directory(path("bin"));
  fs::create_symlink("/usr/bin/gnuplot", path("bin/gnuplot"));
  simulate("a.study");
  const ProgramOutcome outcome =
      jnd({"report", "a.study", "--out", "out", "--resamples", "100", "--json"},
          path("bin").string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["study"], "tiny");
  EXPECT_EQ(json["simulated"], true);
  EXPECT_EQ(json["html"], "out/report.html");
  EXPECT_TRUE(json["pdf"].is_null());
  std::set<std::string> names;
  for (const auto& figure : json["figures"]) {
    const std::string name = figure["name"];
    names.insert(name);
    EXPECT_EQ(figure["problem"], "") << name;
    for (const char* ending : {".svg", ".pdf", ".gp"}) {
      EXPECT_TRUE(fs::exists(path("out/figures/" + name + ending))) << name << ending;
    }
  }
  for (const char* name : {"estimation_curves", "production_boxes", "comparison_psychometric",
                           "strokes", "trajectories"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_NE(read_file(path("out/report.html")).find("<svg"), std::string::npos);
}

TEST_F(ReportCommandTest, AFolderWithSomethingInItIsRefusedBeforeAnythingIsComputed) {
  simulate("a.study");
  fs::create_directory(path("out"));
  write_file(path("out/mine.txt"), "mine");
  const ProgramOutcome outcome = report("a.study", "out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(sentence_flaw(outcome.err, {"out", "nothing is overwritten", "--out"}), "");
  EXPECT_EQ(files("out").size(), 1U);
}

TEST_F(ReportCommandTest, AFolderThatCannotBeWrittenToIsSaid) {
  simulate("a.study");
  write_file(path("file"), "no folder");
  const ProgramOutcome outcome = report("a.study", "file/out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(sentence_flaw(outcome.err, {"file/out", "expected"}), "");
}

TEST_F(ReportCommandTest, AFullDiskIsSaidAndNothingHalfMadeStays) {
  simulate("a.study");
  fs::create_directory(path("disk"));
  for (const int size_kib : {16, 60}) {
    SCOPED_TRACE(size_kib);
    const test_support::SmallDisk disk(path("disk"), size_kib);
    if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
    const ProgramOutcome outcome = report("a.study", "disk/out");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(sentence_flaw(outcome.err, {"disk/out", "expected"}), "");
    EXPECT_FALSE(fs::exists(path("disk/out")));
  }
}

TEST_F(ReportCommandTest, ADoubleBlindStudyShowsNothingUntilItIsUnblinded) {
  write_file(path("blind.json"),
             replaced(kTinyStudy, R"("languages")", R"("blinding": "double", "languages")"));
  simulate("b.study", "1", "blind.json");
  const ProgramOutcome outcome = report("b.study", "out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("unblind"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(path("out")));
  ASSERT_EQ(jnd({"unblind", "b.study", "--reason", "done"}).exit_code, 0);
  EXPECT_EQ(report("b.study", "out").exit_code, 0);
}

TEST_F(ReportCommandTest, OnlyPilotsMakeAReportWhenTheyAreAskedFor) {
  ASSERT_EQ(jnd({"run", "tiny.json", "--study", "p.study", "--participant", "X1", "--headless",
                 "--pilot"})
                .exit_code,
            0);
  EXPECT_EQ(report("p.study", "a").exit_code, 1);
  const ProgramOutcome outcome =
      jnd({"report", "p.study", "--out", "b", "--pilot", "--resamples", "100"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(read_file(path("b/report.html")).find("PILOT sessions"), std::string::npos);
}

TEST_F(ReportCommandTest, AParticipantWhoWithdrewIsInNoFileOfIt) {
  simulate("a.study");
  ASSERT_EQ(jnd({"withdraw", "a.study", "--participant", "P02"}).exit_code, 0);
  ASSERT_EQ(report("a.study", "out").exit_code, 0);
  for (const auto& [name, text] : files("out")) {
    EXPECT_EQ(text.find("P02"), std::string::npos) << name;
  }
}

}  // namespace report_test
}  // namespace jnd::app
