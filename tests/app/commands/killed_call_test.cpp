#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <utility>

#include "app/commands/command_fixture.h"
#include "app/tiny_study.h"
#include "core/storage/backup_mark.h"
#include "core/storage/integrity.h"
#include "support/program.h"
#include "support/sanitizer.h"

namespace jnd::app {
namespace killed_call_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

/// The study is short, because the test copies and reads it hundreds of times.
constexpr const char* kShortStudy = R"json({
  "format": 1, "name": "short", "languages": ["en"], "title": {"en": "Short"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
     "medium": "water", "scale": [0.5, 2], "repetitions": 1, "free_space_between_s": 0,
     "instruction": {"en": "Say."}, "question": {"en": "How strong?"}, "expected_trial_s": 5}
  ]
})json";

/// The system calls that change files. A sync changes nothing for a program that dies.
constexpr const char* kChanging =
    "openat,write,pwrite64,rename,renameat,renameat2,unlink,unlinkat,ftruncate,mkdir,mkdirat,"
    "fallocate,link,linkat,rmdir";

/// A point at which to kill the program: as it enters its nth call of this name.
struct Point {
  std::string name;
  int nth = 0;
  std::string text;  ///< The call, as strace prints it.
};

/// Returns the calls that change a file of the folder. Of many successive calls on one file it
/// keeps the first and every 50th, because those between are parts of one transaction.
std::vector<Point> points_in(const std::string& trace, const std::string& folder) {
  static const std::regex kCall(R"(^\d+ +(\w+)\((\d+<[^>]*>)?.*)");
  std::map<std::string, int> num_calls;
  std::vector<Point> points;
  std::string last;
  int num_in_row = 0;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, kCall)) continue;
    const std::string name = match[1];
    const int nth = ++num_calls[name];
    const bool reads = name == "openat" && line.find("O_CREAT") == std::string::npos &&
                       line.find("O_TRUNC") == std::string::npos;
    // SQLite makes this file anew whenever it opens a database.
    const bool is_index = match[2].str().ends_with("-shm>");
    if (reads || is_index || line.find(folder) == std::string::npos) continue;
    const std::string same = name + match[2].str();
    num_in_row = same == last ? num_in_row + 1 : 0;
    last = same;
    if (num_in_row % 50 != 0) continue;
    points.push_back({name, nth, line.substr(0, 160)});
  }
  return points;
}

std::string bytes_in(const fs::path& folder) {
  std::ostringstream bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    // An empty file would set the stream's failure flag.
    if (!entry.is_regular_file() || entry.file_size() == 0) continue;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
  }
  return std::move(bytes).str();
}

/// Returns what `verify` says about the folder, or "" if the folder is complete.
std::string problems_of(const fs::path& folder) try {
  std::string text;
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  for (const core::Finding& finding : core::verify(store).problems) {
    text += finding.message + "\n";
  }
  return text;
} catch (const core::Error& error) {
  return error.what();
}

class KilledCall : public CommandTest {
 protected:
  void SetUp() override {
    if (test_support::kIsSanitized) GTEST_SKIP() << "hundreds of runs, each ten times as slow";
    write_file(path("short.json"), kShortStudy);
    try {
      if (traced({"--version"}, {}).exit_code != 0) throw std::runtime_error("not allowed");
    } catch (const std::runtime_error&) {
      GTEST_SKIP() << "strace is not installed, or may not follow programs here";
    }
    done({"simulate", "short.json", "--study", "now/a.study", "--participants", "2", "--seed",
          "7"});
    done({"exclude", "now/a.study", "--participant", "P01", "--trial", "1", "--reason", kMark});
  }

  [[nodiscard]] fs::path now(const std::string& name) const { return path("now") / name; }
  void done(const std::vector<std::string>& words) {
    const ProgramOutcome outcome = jnd(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  }
  ProgramOutcome traced(const std::vector<std::string>& words,
                        const std::vector<std::string>& more) {
    std::vector<std::string> wrapper = {"strace", "-f",
                                        "-y",     "-qq",
                                        "-o",     path("trace").string(),
                                        "-e",     std::string("trace=") + kChanging};
    wrapper.insert(wrapper.end(), more.begin(), more.end());
    return test_support::run_program(
        words, {.folder = temporary_.path(), .environment = {}, .wrapper = wrapper});
  }

  /// Runs the command once for each of its calls and kills it at that call. Each run starts
  /// from what folder "now" held when `sweep` was called, and `check` looks at what is left.
  template <typename Check>
  void sweep(const std::vector<std::string>& words, const Check& check) {
    fs::copy(path("now"), path("before"), fs::copy_options::recursive);
    ASSERT_EQ(traced(words, {}).exit_code, 0);
    const std::vector<Point> points = points_in(read_file(path("trace")), "now/");
    EXPECT_GT(points.size(), 30U);
    for (const Point& point : points) {
      SCOPED_TRACE(point.text);
      fs::remove_all(path("now"));
      fs::copy(path("before"), path("now"), fs::copy_options::recursive);
      const ProgramOutcome killed = traced(
          words,
          {"-e", "inject=" + point.name + ":signal=KILL:when=" + std::to_string(point.nth)});
      ASSERT_EQ(killed.signal, SIGKILL) << killed.exit_code << killed.err;
      check();
      if (HasFailure()) return;  // One failure is enough to read.
    }
  }

  /// Returns whether the folder still contains any data of the first person.
  [[nodiscard]] bool holds_person(const std::string& folder) const {
    return bytes_in(now(folder)).find(kMark) != std::string::npos ||
           fs::exists(now(folder) / "recordings" / "0001.sqlite");
  }
  [[nodiscard]] std::size_t num_withdrawn(const std::string& folder) const {
    return core::StudyStore(now(folder), core::StudyStore::Mode::kReadOnly)
        .withdrawals()
        .size();
  }

  static constexpr const char* kMark = "the mark of the first person";
};

TEST_F(KilledCall, AWithdrawalIsToldTrulyWhereverItWasKilledAndMendedByItsRepetition) {
  const std::vector<std::string> folders = {"a.study", "first", "second"};
  done({"backup", "now/a.study", "--to", "now/first"});
  done({"backup", "now/a.study", "--to", "now/second"});
  const std::vector<std::string> words = {"withdraw", "now/a.study", "--participant", "P01"};
  sweep(words, [&] {
    const bool is_done = num_withdrawn("a.study") > 0 && problems_of(now("a.study")).empty();
    for (const std::string& folder : folders) {
      SCOPED_TRACE(folder);
      const std::string problems = problems_of(now(folder));
      if (!problems.empty()) {
        EXPECT_NE(problems.find("jnd withdraw"), std::string::npos) << problems;
      } else if (is_done || num_withdrawn(folder) > 0) {
        EXPECT_FALSE(holds_person(folder)) << "and nothing says so";
      }
    }
    done(words);
    for (const std::string& folder : folders) {
      EXPECT_EQ(problems_of(now(folder)), "") << folder;
      EXPECT_FALSE(holds_person(folder)) << folder;
      EXPECT_EQ(num_withdrawn(folder), 1U) << folder;
    }
  });
}

TEST_F(KilledCall, TheEarlierBackupIsWholeWhereverTheNextWasKilledAndMendedByItsRepetition) {
  done({"backup", "now/a.study", "--to", "now/copy"});
  done({"simulate", "short.json", "--study", "now/a.study", "--participants", "1", "--seed",
        "8"});
  done({"exclude", "now/a.study", "--participant", "P01", "--trial", "2", "--reason", "x"});
  const std::vector<std::string> words = {"backup", "now/a.study", "--to", "now/copy"};
  const auto num_sessions = [&] {
    return core::StudyStore(now("copy"), core::StudyStore::Mode::kReadOnly).sessions().size();
  };
  std::size_t num_earlier = 0;
  std::size_t num_later = 0;
  sweep(words, [&] {
    EXPECT_EQ(problems_of(now("a.study")), "");
    EXPECT_EQ(problems_of(now("copy")), "");
    EXPECT_TRUE(core::is_backup(now("copy")));
    const std::size_t num = num_sessions();
    EXPECT_TRUE(num == 2 || num == 3) << num;
    ++(num == 2 ? num_earlier : num_later);
    done(words);
    EXPECT_EQ(problems_of(now("copy")), "");
    EXPECT_EQ(num_sessions(), 3U);
    EXPECT_FALSE(core::is_unfinished_backup(now("copy")));
  });
  EXPECT_GT(num_earlier, 20U);
  EXPECT_GT(num_later, 2U);
}

TEST_F(KilledCall, AFirstBackupIsMendedByItsRepetitionWhereverItWasKilled) {
  const std::vector<std::string> words = {"backup", "now/a.study", "--to", "now/copy"};
  sweep(words, [&] {
    EXPECT_EQ(problems_of(now("a.study")), "");
    done(words);
    EXPECT_EQ(problems_of(now("copy")), "");
    EXPECT_TRUE(core::is_backup(now("copy")));
  });
}

}  // namespace killed_call_test
}  // namespace jnd::app
