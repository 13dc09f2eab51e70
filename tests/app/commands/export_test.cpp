#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace export_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

TEST(ExportCommand, WritesTheTablesAndRefusesAFolderThatIsNotEmpty) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const test_support::ProgramOptions options{.folder = temporary.path(), .environment = {}};
  write_file(temporary.path() / "tiny.json", kTinyStudy);
  ASSERT_EQ(test_support::run_program(
                {"simulate", "tiny.json", "--participants", "1", "--study", "a.study"}, options)
                .exit_code,
            0);
  const std::vector<std::string> words = {"export", "csv",        "a.study",
                                          "--out",  "out/of/way", "--recordings"};
  const ProgramOutcome outcome = test_support::run_program(words, options);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name : {"sessions.csv", "trials.csv", "presentations.csv", "events.csv",
                           "answers.csv", "codebook.csv", "recordings/0001.csv"}) {
    EXPECT_TRUE(fs::exists(temporary.path() / "out/of/way" / name)) << name;
  }
  const std::string before = read_file(temporary.path() / "out/of/way/trials.csv");
  const ProgramOutcome again = test_support::run_program(words, options);
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.err.find("nothing is overwritten"), std::string::npos);
  EXPECT_EQ(read_file(temporary.path() / "out/of/way/trials.csv"), before);
}

/// Whatever the usual permissions of the machine are, only the owner may read the data of
/// persons.
TEST(ExportCommand, WhatItWritesIsForItsOwnerOnly) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const test_support::ProgramOptions options{.folder = temporary.path(), .environment = {}};
  write_file(temporary.path() / "tiny.json", kTinyStudy);
  const std::vector<std::vector<std::string>> commands = {
      {"simulate", "tiny.json", "--participants", "1", "--study", "a.study", "--fast"},
      {"export", "csv", "a.study", "--out", "csv"},
      {"export", "bids", "a.study", "--out", "bids"},
      {"report", "a.study", "--out", "report"}};
  for (const std::vector<std::string>& words : commands) {
    ASSERT_EQ(test_support::run_program(words, options).exit_code, 0) << words.front();
  }
  for (const char* folder : {"csv", "bids", "report"}) {
    const auto expect_own = [](const fs::path& path) {
      EXPECT_EQ(fs::status(path).permissions() & (fs::perms::group_all | fs::perms::others_all),
                fs::perms::none)
          << path;
    };
    expect_own(temporary.path() / folder);
    for (const auto& entry : fs::recursive_directory_iterator(temporary.path() / folder)) {
      expect_own(entry.path());
    }
  }
}

TEST(ExportCommand, CarriesOneRowAnAnsweredTrial) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const test_support::ProgramOptions options{.folder = temporary.path(), .environment = {}};
  write_file(temporary.path() / "tiny.json", kTinyStudy);
  ASSERT_EQ(test_support::run_program({"simulate", "tiny.json", "--participants", "3",
                                       "--study", "a.study", "--fast"},
                                      options)
                .exit_code,
            0);
  ASSERT_EQ(
      test_support::run_program({"export", "csv", "a.study", "--out", "o"}, options).exit_code,
      0);
  const std::string trials = read_file(temporary.path() / "o/trials.csv");
  EXPECT_EQ(std::count(trials.begin(), trials.end(), '\n'), 1 + 3 * kTinyTrials);
}

/// Holds a recorded study with two simulated participants of the tiny study.
class RecordedStudy {
 public:
  RecordedStudy() {
    write_file(path("tiny.json"), kTinyStudy);
    const ProgramOutcome made =
        jnd({"simulate", "tiny.json", "--participants", "2", "--study", "a.study"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
  }
  [[nodiscard]] ProgramOutcome jnd(const std::vector<std::string>& arguments) const {
    return test_support::run_program(arguments,
                                     {.folder = temporary_.path(), .environment = {}});
  }
  [[nodiscard]] fs::path path(const std::string& name) const {
    return temporary_.path() / name;
  }
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(temporary_.path())) {
      all.insert(entry.path().filename());
    }
    return all;
  }

 private:
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

TEST(ExportCommand, TheFitsOfABidsDataSetAreThoseOfResults) {
  const RecordedStudy study;
  const ProgramOutcome outcome = study.jnd({"export", "bids", "a.study", "--out", "bids"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("--recordings adds it"), std::string::npos) << outcome.out;
  const ProgramOutcome results = study.jnd({"results", "a.study", "--json"});
  EXPECT_EQ(nlohmann::json::parse(read_file(study.path("bids/derivatives/jnd/results.json"))),
            nlohmann::json::parse(results.out));
  EXPECT_FALSE(fs::exists(study.path("bids/sub-P01/ses-01/motion")));
}

TEST(ExportCommand, TheSourceOfABidsDataSetIsAWholeStudy) {
  const RecordedStudy study;
  ASSERT_EQ(study.jnd({"export", "bids", "a.study", "--out", "bids", "--recordings"}).exit_code,
            0);
  const ProgramOutcome verified = study.jnd({"verify", "bids/sourcedata/jnd.study"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
}

TEST(ExportCommand, NamesThePilotsOfAStudyThatHasNothingElse) {
  const RecordedStudy study;
  ASSERT_EQ(study
                .jnd({"run", "tiny.json", "--study", "p.study", "--participant", "P01",
                      "--headless", "--pilot"})
                .exit_code,
            0);
  const ProgramOutcome refused = study.jnd({"export", "bids", "p.study", "--out", "bids"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(sentence_flaw(refused.err, {"p.study", "--pilot"}), "");
  const ProgramOutcome done =
      study.jnd({"export", "bids", "p.study", "--out", "bids", "--pilot"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_FALSE(fs::exists(study.path("bids/derivatives"))) << "no fits of pilots";
}

TEST(ExportCommand, AFullDiskIsOneSentenceAndLeavesNothing) {
  const RecordedStudy study;
  fs::create_directory(study.path("disk"));
  for (const char* format : {"csv", "bids", "hdf5"}) {
    for (const int size_kib : {4, 64, 400, 900}) {
      const test_support::SmallDisk disk(study.path("disk"), size_kib);
      if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
      const ProgramOutcome outcome =
          study.jnd({"export", format, "a.study", "--out", "disk/out", "--recordings"});
      EXPECT_EQ(outcome.exit_code, 1) << format << size_kib << outcome.err;
      EXPECT_EQ(sentence_flaw(outcome.err, {"disk/out", "expected"}), "") << format << size_kib;
      EXPECT_EQ(outcome.err.find("unfinished"), std::string::npos) << outcome.err;
      EXPECT_TRUE(fs::is_empty(study.path("disk"))) << format << size_kib;
    }
  }
}

/// The parent folder of a mount point is on another disk, so nothing can be renamed from there.
TEST(ExportCommand, AnEmptyMountPointIsFilledOnItsOwnDisk) {
  const RecordedStudy study;
  fs::create_directory(study.path("disk"));
  const test_support::SmallDisk disk(study.path("disk"), 20000);
  if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
  const std::set<std::string> before = study.names();
  const ProgramOutcome outcome = study.jnd({"export", "csv", "a.study", "--out", "disk"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(study.path("disk/trials.csv")));
  EXPECT_EQ(study.names(), before);
}

TEST(ExportCommand, ARightThatLacksIsExitThree) {
  std::error_code error;
  if (fs::create_directory("/sys/jnd", error) || error == std::errc::read_only_file_system) {
    GTEST_SKIP() << "/sys is another one here";
  }
  const RecordedStudy study;
  const ProgramOutcome outcome = study.jnd({"export", "csv", "a.study", "--out", "/sys/jnd"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(sentence_flaw(outcome.err, {"/sys/jnd", "expected"}), "");
}

TEST(ExportCommand, AMissingRecordingIsOneSentenceAndExitOneAndTheRestIsWritten) {
  const RecordedStudy study;
  fs::remove(study.path("a.study/recordings/0002.sqlite"));
  for (const char* format : {"csv", "bids", "hdf5"}) {
    const ProgramOutcome outcome =
        study.jnd({"export", format, "a.study", "--out", format, "--recordings"});
    EXPECT_EQ(outcome.exit_code, 1) << format;
    EXPECT_EQ(sentence_flaw(outcome.err, {"recordings/0002.sqlite", "session 2"}), "")
        << format;
    EXPECT_NE(outcome.out.find("written to"), std::string::npos) << format;
    EXPECT_TRUE(fs::exists(study.path(format))) << format;
  }
  EXPECT_EQ(study.jnd({"export", "csv", "a.study", "--out", "tables"}).exit_code, 0)
      << "tables need no recording";
}

TEST(ExportCommand, ASignalEndsItInOneSentenceAndLeavesNothing) {
  const RecordedStudy study;
  const std::set<std::string> before = study.names();
  ProgramOutcome outcome;
  // The program may have finished before the signal arrived, so the test tries again.
  for (int attempt = 0; attempt < 20 && outcome.exit_code != 1; ++attempt) {
    fs::remove_all(study.path("out"));
    test_support::RunningProgram program(
        {"export", "csv", "a.study", "--out", "out", "--recordings"},
        {.folder = study.path(""), .environment = {}});
    while (study.names() == before && !program.has_ended()) {
    }
    program.send_signal(SIGINT);
    outcome = program.wait();
  }
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(sentence_flaw(outcome.err, {"out", "signal", "nothing was written"}), "");
  EXPECT_EQ(study.names(), before);
}

TEST(ExportCommand, AFolderThatCannotBeWrittenIsOneSentence) {
  const RecordedStudy study;
  fs::create_directory(study.path("disk"));
  const test_support::SmallDisk disk(study.path("disk"), 1000);
  if (!disk.mounted() || !disk.make_read_only()) {
    GTEST_SKIP() << "mounting a disk is not allowed here";
  }
  for (const char* format : {"csv", "bids", "hdf5"}) {
    const ProgramOutcome outcome =
        study.jnd({"export", format, "a.study", "--out", "disk/out"});
    EXPECT_EQ(outcome.exit_code, 1) << format;
    EXPECT_EQ(sentence_flaw(outcome.err, {"disk/out", "expected"}), "") << format;
  }
}

/// Returns where `./dev test` or npm's global folder holds the validator, or "" if neither
/// does.
std::string bids_validator() {
  const std::string in_module = "/bids-validator/bin/bids-validator";
  const std::string local =
      test_support::source_folder().string() + "/build/bids-validator/node_modules" + in_module;
  for (const std::string& file : {local, "/usr/local/lib/node_modules" + in_module,
                                  "/usr/lib/node_modules" + in_module}) {
    if (fs::exists(file)) return file;
  }
  return "";
}

TEST(ExportCommand, TheOfficialValidatorFindsNoErrorInABidsDataSet) {
  const std::string validator = bids_validator();
  if (validator.empty() || std::system("node --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "bids-validator 1.15.0 is not there; `./dev test` installs it by npm";
  }
  const RecordedStudy study;
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--recordings"}}) {
    const std::string out = more.empty() ? "plain" : "recorded";
    std::vector<std::string> words = {"export", "bids", "a.study", "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(study.jnd(words).exit_code, 0);
    const fs::path said = study.path(out + ".json");
    (void)std::system(("node '" + validator + "' --json '" + study.path(out).string() + "' >'" +
                       said.string() + "' 2>/dev/null")
                          .c_str());
    const nlohmann::json verdict = nlohmann::json::parse(read_file(said));
    EXPECT_TRUE(verdict["issues"]["errors"].empty()) << verdict["issues"]["errors"].dump(2);
    EXPECT_EQ(verdict["summary"]["subjects"].size(), 2U);
    EXPECT_EQ(verdict["summary"]["tasks"].size(), more.empty() ? 3U : 4U)
        << "the fourth is of explored media, of which there is motion alone";
  }
}

}  // namespace export_test
}  // namespace jnd::app
