#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace jnd::test_support {

/// The result of a run of the program.
struct ProgramOutcome {
  int exit_code = -1;  ///< -1 if a signal ended the program.
  int signal = 0;      ///< The signal that ended the program, or 0.
  std::string out;     ///< All of stdout that was not read by `read_line`.
  std::string err;     ///< All of stderr.
};

struct ProgramOptions {
  std::filesystem::path folder;  ///< The working folder; the test's own if empty.
  /// Added to the test's own environment, from which displays and JND_SHARE are taken out.
  std::vector<std::pair<std::string, std::string>> environment;
  /// A command that runs the program, such as {"strace", "-f"}.
  std::vector<std::string> wrapper = {};
  /// The file that stdout goes to instead of to the test.
  std::filesystem::path out_file = {};
  std::string program = {};  ///< A program to run instead of jnd: a path, or a name on PATH.
};

/// The jnd program as a child of the test, with every signal at its default. Throws
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
  /// Whether the program has ended, so that nobody has to wait for it.
  [[nodiscard]] bool has_ended() const;
  /// Closes the reading end of the program's stdout, as `head` does.
  void stop_reading();
  [[nodiscard]] ProgramOutcome wait();

 private:
  bool read_more();

  pid_t pid_ = -1;
  int out_ = -1;  ///< The read end of the program's stdout; -1 once closed.
  int err_ = -1;  ///< The file that takes the program's stderr.
  std::string buffer_;
};

/// The path of a program of this machine; "" if it is not installed.
[[nodiscard]] std::string installed_program(const std::string& name);

/// Runs the program and waits for its end.
[[nodiscard]] ProgramOutcome run_program(const std::vector<std::string>& arguments,
                                         const ProgramOptions& options = {});

}  // namespace jnd::test_support
