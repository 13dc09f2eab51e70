#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>
#include <vector>

#include "chaos/told_events.h"
#include "chaos/worlds.h"
#include "core/random_stream.h"
#include "support/places.h"
#include "support/program.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"

namespace jnd::chaos {
namespace {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

/// What can happen to a run of the program before its study is finished.
enum class Interruption {
  kKilledAfterAnAnswer,  ///< The program is killed right after a line that it printed.
  kKilledAtAnyMoment,
  kStopped,  ///< SIGSTOP, and SIGCONT after a while. The program then has to finish.
  kDiskIsFull,
  kSyncFails,  ///< The call fails once, or from then on.
  kWriteFails,
};
constexpr int kNumInterruptions = 6;

bool can_follow_system_calls() {
  static const bool can =
      std::system("strace -qq -o /dev/null true >/dev/null 2>&1") == 0;  // NOLINT
  return can;
}

/// Runs one study, which the real program writes while the machine works against it.
class ProcessWorld {
 public:
  explicit ProcessWorld(const Schedule& schedule)
      : random_(schedule.seed, "processes"), seed_(schedule.seed) {
    fs::create_directory(disk_folder());
  }

  Outcome play() {
    if (!fs::exists(test_support::program_file())) return {.was_played = false};
    disk_.emplace(disk_folder(), kRoomy_kib);
    const int num = 1 + static_cast<int>(random_.below(4));
    for (int i = 0; i < num && violation_.empty(); ++i) {
      meet(static_cast<Interruption>(random_.below(kNumInterruptions)));
      judge(false);
    }
    if (violation_.empty()) finish();
    return {.violation = violation_};
  }

 private:
  static constexpr int kRoomy_kib = 200'000;

  [[nodiscard]] fs::path disk_folder() const { return temporary_.path() / "disk"; }
  [[nodiscard]] fs::path study() const { return disk_folder() / "a.study"; }

  [[nodiscard]] std::vector<std::string> run_words() const {
    const fs::path protocol = test_support::source_folder() / "protocols" / "short_tour.json";
    return {"run",           protocol,       "--study", study(),
            "--participant", "P01",          "--seed",  std::to_string(seed_ % 1'000'000),
            "--headless",    "--acknowledge"};
  }
  [[nodiscard]] std::vector<std::string> resume_words() const {
    return {"resume", study(), "--headless", "--acknowledge"};
  }
  /// As a person would, the test resumes a session that has begun.
  [[nodiscard]] std::vector<std::string> next_words() const {
    return told_.empty() ? run_words() : resume_words();
  }

  void meet(Interruption interruption) {
    switch (interruption) {
      case Interruption::kKilledAfterAnAnswer:
        return kill_after_lines(1 + random_.below(250));
      case Interruption::kKilledAtAnyMoment:
        return signal_after(SIGKILL, random_.uniform(0.0, 0.6));
      case Interruption::kStopped:
        return stop_for(random_.uniform(0.01, 0.3));
      case Interruption::kDiskIsFull:
        return fill_disk();
      case Interruption::kSyncFails:
        return fail_calls("fsync,fdatasync", "EIO");
      case Interruption::kWriteFails:
        return fail_calls("pwrite64,write", "ENOSPC");
    }
  }

  void kill_after_lines(std::uint64_t num_lines) {
    met_ = "it was killed after a line that it told";
    RunningProgram program(next_words(), options({}));
    for (std::uint64_t i = 0; i < num_lines; ++i) {
      const auto line = program.read_line();
      if (!line) break;
      told_.add(*line);
    }
    program.send_signal(SIGKILL);
    take(program.wait());
  }

  void signal_after(int signal, double after_s) {
    met_ = "it was killed";
    RunningProgram program(next_words(), options({}));
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    program.send_signal(signal);
    take(program.wait());
  }

  void stop_for(double duration_s) {
    met_ = "it was stopped and went on";
    const bool must_finish = !told_.empty() || !fs::exists(study());
    RunningProgram program(next_words(), options({}));
    std::this_thread::sleep_for(std::chrono::duration<double>(random_.uniform(0.0, 0.4)));
    program.send_signal(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::duration<double>(duration_s));
    program.send_signal(SIGCONT);
    const ProgramOutcome outcome = program.wait();
    if (must_finish && outcome.exit_code != 0) violated("it did not finish: " + outcome.err);
    take(outcome);
  }

  void fill_disk() {
    met_ = "its disk was full";
    const int taken_kib = static_cast<int>(taken_bytes() / 1024);
    if (!disk_->mounted() ||
        !disk_->resize(taken_kib + 8 + static_cast<int>(random_.below(600)))) {
      return;
    }
    take(test_support::run_program(next_words(), options({})));
    if (!disk_->resize(kRoomy_kib)) violated("the disk could not be made larger again");
  }

  [[nodiscard]] std::uintmax_t taken_bytes() const {
    const fs::space_info space = fs::space(disk_folder());
    return space.capacity - space.free;
  }

  /// Makes calls of one thread fail, beginning with one of its first calls: once, or for ever.
  void fail_calls(const std::string& calls, const std::string& error) {
    met_ = "its calls of " + calls + " failed";
    if (!can_follow_system_calls()) return;
    const std::string when =
        std::to_string(1 + random_.below(400)) + (random_.with_probability(0.5) ? "+" : "");
    std::vector<std::string> wrapper = {"strace", "-f", "-qq", "-o", "/dev/null"};
    for (const char* file : {"", "study.sqlite", "study.sqlite-wal", "recordings/0001.sqlite",
                             "recordings/0001.sqlite-wal"}) {
      wrapper.insert(wrapper.end(), {"-P", (study() / file).string()});
    }
    wrapper.insert(wrapper.end(),
                   {"-e", "inject=" + calls + ":error=" + error + ":when=" + when});
    take(test_support::run_program(next_words(), options(wrapper)));
  }

  [[nodiscard]] test_support::ProgramOptions options(
      const std::vector<std::string>& wrapper) const {
    return {.folder = temporary_.path(), .environment = {}, .wrapper = wrapper};
  }

  void take(const ProgramOutcome& outcome) { told_.take(outcome); }

  void judge(bool is_finished) {
    const std::string problem = told_.problem(options({}));
    if (!problem.empty()) return violated(problem);
    if (is_finished && !told_.session_is_complete()) violated("the session has no end");
  }

  void finish() {
    met_ = "nothing was wrong any more";
    ProgramOutcome outcome = test_support::run_program(resume_words(), options({}));
    const bool is_resumed = outcome.exit_code == 0 && outcome.out.starts_with("EVENT");
    if (!is_resumed && told_.empty()) {
      // The program was killed before it had made its folder or its session.
      outcome = test_support::run_program(run_words(), options({}));
    }
    if (outcome.exit_code != 0) return violated("it did not finish: " + outcome.err);
    take(outcome);
    judge(true);
  }

  void violated(const std::string& what) {
    if (violation_.empty()) violation_ = "the program when " + met_ + ": " + what;
  }

  core::RandomStream random_;
  std::uint64_t seed_;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  std::optional<test_support::SmallDisk> disk_;
  ToldEvents told_{study()};
  std::string met_;
  std::string violation_;
};

}  // namespace

Outcome played_by_processes(const Schedule& schedule) { return ProcessWorld(schedule).play(); }

}  // namespace jnd::chaos
