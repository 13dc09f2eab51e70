#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "app/acknowledged.h"
#include "app/commands/command_fixture.h"
#include "app/tiny_study.h"
#include "support/program.h"

namespace jnd::app {
namespace sync_trace_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

/// A completed system call, as `strace -y` prints it.
struct Call {
  std::string name;
  std::string file;  ///< The file for which the call's first argument stands.
  std::string text;  ///< The whole line of the trace.
};

/// Returns the calls in their order. A write is placed where it begins, and a sync where it
/// ended.
std::vector<Call> calls_in(const std::string& trace) {
  static const std::regex kWhole(R"(^(\d+) +(\w+)\(\d+<([^>]*)>.* = (-?\d+).*)");
  static const std::regex kBegun(R"(^(\d+) +(\w+)\(\d+<([^>]*)>.*<unfinished \.\.\.>$)");
  static const std::regex kEnded(R"(^(\d+) +<\.\.\. (\w+) resumed>.* = (-?\d+).*)");
  std::vector<Call> calls;
  std::map<std::string, Call> under_way;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kBegun)) {
      const Call call{match[2], match[3], line};
      if (call.name.find("sync") == std::string::npos) {
        calls.push_back(call);
      } else {
        under_way[match[1]] = call;
      }
    } else if (std::regex_match(line, match, kEnded)) {
      if (const auto begun = under_way.find(match[1]); begun != under_way.end()) {
        if (match[3] == "0") calls.push_back(begun->second);
        under_way.erase(begun);
      }
    } else if (std::regex_match(line, match, kWhole) && !match[4].str().starts_with("-")) {
      calls.push_back({match[2], match[3], line});
    }
  }
  return calls;
}

/// Follows which files hold data that are not on the disk yet.
class SyncTrace : public CommandTest {
 protected:
  /// Returns the system calls of a whole session, or "" if they cannot be traced.
  std::string trace_of_a_session() {
    write_file(temporary_.path() / "tiny.json", kTinyStudy);
    const fs::path trace = temporary_.path() / "trace";
    try {
      // A short program shows first whether tracing is allowed here at all.
      if (traced(trace, {"--version"}).exit_code != 0) return "";
      const ProgramOutcome outcome =
          traced(trace, {"run", "tiny.json", "--study", "new/a.study", "--participant", "P01",
                         "--headless", "--seed", "7", "--acknowledge"});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      acknowledged_ = lines_of(outcome.out);
    } catch (const std::runtime_error&) {
      return "";  // strace is not installed.
    }
    return read_file(trace);
  }

  ProgramOutcome traced(const fs::path& trace, const std::vector<std::string>& words) {
    return test_support::run_program(
        words, {.folder = temporary_.path(),
                .environment = {},
                .wrapper = {"strace", "-f", "-y", "-qq", "-o", trace.string(), "-e",
                            "trace=write,pwrite64,fsync,fdatasync,ftruncate"}});
  }

  [[nodiscard]] std::string path_of(const std::string& name) const {
    return (fs::canonical(temporary_.path()) / name).string();
  }

  std::vector<std::string> acknowledged_;
};

TEST_F(SyncTrace, EveryEventIsOnDiskBeforeItIsAcknowledgedAndItsSamplesBeforeIt) {
  const std::string trace = trace_of_a_session();
  if (trace.empty()) GTEST_SKIP() << "strace is not installed, or may not follow programs here";
  const std::string log = path_of("new/a.study/study.sqlite-wal");
  const std::string samples = path_of("new/a.study/recordings/0001.sqlite-wal");
  static const std::regex kEvent(R"(.*"EVENT (\d+) (\w+)\\n".*)");
  std::set<std::string> unsynced;  // The files that were written to since their last sync.
  std::set<std::string> synced;    // The files that were synced since the last acknowledgement.
  bool samples_came_first = false;
  std::size_t num_events = 0;
  std::size_t num_with_samples = 0;
  for (const Call& call : calls_in(trace)) {
    std::smatch event;
    if (call.name == "fsync" || call.name == "fdatasync") {
      unsynced.erase(call.file);
      synced.insert(call.file);
      continue;
    }
    if (!std::regex_match(call.text, event, kEvent)) {
      if (call.file == log && !unsynced.contains(log)) {
        samples_came_first = synced.contains(samples) && !unsynced.contains(samples);
      }
      unsynced.insert(call.file);
      continue;
    }
    ++num_events;
    EXPECT_TRUE(synced.contains(log)) << "acknowledged, not synced: " << call.text;
    EXPECT_FALSE(unsynced.contains(log)) << "written after the sync: " << call.text;
    const std::string kind = event[2];
    if (kind == "presentation_ended" || kind == "medium_explored") {
      EXPECT_TRUE(samples_came_first) << "samples not on disk before: " << call.text;
      ++num_with_samples;
    }
    if (kind == "trial_answered") {
      EXPECT_FALSE(unsynced.contains(samples)) << call.text;
    }
    synced.clear();
  }
  EXPECT_EQ(num_events, acknowledged_.size());
  EXPECT_GT(num_events, 50U);
  EXPECT_GT(num_with_samples, 10U);
}

TEST_F(SyncTrace, TheNamesOfNewFilesAndFoldersAreOnDiskBeforeTheFirstAcknowledgement) {
  const std::string trace = trace_of_a_session();
  if (trace.empty()) GTEST_SKIP() << "strace is not installed, or may not follow programs here";
  std::set<std::string> synced;
  for (const Call& call : calls_in(trace)) {
    if (call.text.find("\"EVENT ") != std::string::npos) break;
    if (call.name == "fsync" || call.name == "fdatasync") synced.insert(call.file);
  }
  for (const char* folder : {"new/a.study/recordings", "new/a.study", "new", ""}) {
    std::string path = path_of(folder);
    if (path.ends_with("/")) path.pop_back();
    EXPECT_TRUE(synced.contains(path)) << "folder not synced: " << path;
  }
}

}  // namespace sync_trace_test
}  // namespace jnd::app
