#include "analysis/report/run_tool.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> child_environment() {
  std::vector<std::string> all;
  for (char** entry = ::environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    // A figure must be the same everywhere, and no window may open.
    const bool is_ours = text.starts_with("TZ=") || text.starts_with("LC_ALL=") ||
                         text.starts_with("DISPLAY=") || text.starts_with("GNUPLOT_");
    if (!is_ours) all.emplace_back(text);
  }
  all.emplace_back("TZ=UTC");
  all.emplace_back("LC_ALL=C.UTF-8");
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Starts the program in its own process group, so that all of it can be ended. Returns -1 with
/// `errno` if that fails.
pid_t start(const fs::path& program, const std::vector<std::string>& arguments,
            const fs::path& folder, int output) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = child_environment();
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  sigset_t every;
  ::sigfillset(&every);
  sigset_t none;
  ::sigemptyset(&none);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigdefault(&attributes, &every);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(
      &attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  pid_t pid = -1;
  const int refused = ::posix_spawn(&pid, program.c_str(), &actions, &attributes,
                                    pointers_to(words).data(), pointers_to(environment).data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  errno = refused;
  return refused == 0 ? pid : -1;
}

/// Waits for the process and returns its status, or returns false if the time limit came first.
bool wait_for(pid_t pid, std::chrono::seconds time_limit, int& status) {
  const auto end = std::chrono::steady_clock::now() + time_limit;
  auto pause = std::chrono::milliseconds(1);
  while (true) {
    const pid_t ended = ::waitpid(pid, &status, WNOHANG);
    if (ended == pid || (ended < 0 && errno != EINTR)) return true;
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(pause);
    if (pause < std::chrono::milliseconds(20)) pause *= 2;
  }
}

/// The first words of the output, on one line.
std::string words_of(int output) {
  std::array<char, 300> bytes{};
  const ssize_t count = ::pread(output, bytes.data(), bytes.size(), 0);
  std::string words;
  for (ssize_t i = 0; i < count; ++i) {
    const char letter = bytes[static_cast<std::size_t>(i)];
    const bool is_space = static_cast<unsigned char>(letter) <= 0x20;
    if (!is_space) {
      words += letter;
    } else if (!words.empty() && words.back() != ' ') {
      words += ' ';
    }
  }
  return words;
}

}  // namespace

fs::path find_tool(const std::vector<std::string>& names) {
  const char* const path = std::getenv("PATH");
  if (path == nullptr) return {};
  for (const std::string& name : names) {
    std::string_view rest = path;
    while (!rest.empty()) {
      const std::size_t end = rest.find(':');
      fs::path candidate = fs::path(rest.substr(0, end)) / name;
      rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
      std::error_code ignored;
      if (candidate.is_absolute() && fs::is_regular_file(candidate, ignored) &&
          ::access(candidate.c_str(), X_OK) == 0) {
        return candidate;
      }
    }
  }
  return {};
}

ToolOutcome run_tool(const fs::path& program, const std::vector<std::string>& arguments,
                     const fs::path& folder, std::chrono::seconds time_limit) {
  const int output = ::memfd_create("output", MFD_CLOEXEC);
  if (output < 0) return {.problem = std::string("cannot start: ") + std::strerror(errno)};
  const pid_t pid = start(program, arguments, folder, output);
  if (pid < 0) {
    ::close(output);
    return {.problem = std::string("cannot start: ") + std::strerror(errno)};
  }
  ToolOutcome outcome;
  int status = 0;
  if (!wait_for(pid, time_limit, status)) {
    ::kill(-pid, SIGKILL);
    ::waitpid(pid, &status, 0);
    outcome.problem =
        "did not end within " + std::to_string(time_limit.count()) + " s and was stopped";
  } else if (WIFSIGNALED(status)) {
    outcome.problem = "ended by signal " + std::to_string(WTERMSIG(status));
  } else if (WEXITSTATUS(status) != 0) {
    outcome.problem = words_of(output);
    if (outcome.problem.empty()) {
      outcome.problem = "ended with exit code " + std::to_string(WEXITSTATUS(status));
    }
  } else {
    outcome.ok = true;
  }
  ::close(output);
  return outcome;
}

}  // namespace jnd::analysis
