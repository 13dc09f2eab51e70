#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace jnd::test_support {

/// The outcome of a run of the program.
struct ProgramOutcome {
  int exit_code = -1;  ///< The exit code, or -1 if a signal ended the program.
  int signal = 0;      ///< The signal that ended the program, or 0.
  std::string out;     ///< Everything on stdout that `read_line` has not read.
  std::string err;     ///< Everything on stderr.
};

struct ProgramOptions {
  /// The folder in which the program runs. If empty, it is the test's own.
  std::filesystem::path folder;
  /// Variables that are added to the test's own environment, from which displays and JND_SHARE
  /// are removed.
  std::vector<std::pair<std::string, std::string>> environment;
  /// A program that runs the program, for example {"strace", "-f"}.
  std::vector<std::string> wrapper = {};
  std::filesystem::path out_file = {};  ///< The file that gets stdout in place of the test.
  std::string program = {};  ///< Another program in place of jnd: a path, or a name on PATH.
};

/// Runs the program jnd as a child of the test, with every signal at its default. Throws
/// `std::runtime_error` if the system refuses.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments,
                          const ProgramOptions& options = {});
  /// Kills the program if it still runs.
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Returns the next line of stdout without its line end, or nothing at the end of the stream.
  [[nodiscard]] std::optional<std::string> read_line();
  void send_signal(int number) const;
  [[nodiscard]] pid_t process() const noexcept { return pid_; }
  /// Returns whether the program has ended, so that `wait` returns at once.
  [[nodiscard]] bool has_ended() const;
  /// Closes the reading end of the program's stdout, as `head` does.
  void stop_reading();
  [[nodiscard]] ProgramOutcome wait();

 private:
  bool read_more();

  pid_t pid_ = -1;
  int out_ = -1;  ///< The reading end of the program's stdout, or -1 after it was closed.
  int err_ = -1;  ///< The file that gets the program's stderr.
  std::string buffer_;
};

/// Returns the path of a program of this machine, or "" if it is not installed.
[[nodiscard]] std::string installed_program(const std::string& name);

/// Runs the program and waits for its end.
[[nodiscard]] ProgramOutcome run_program(const std::vector<std::string>& arguments,
                                         const ProgramOptions& options = {});

}  // namespace jnd::test_support
