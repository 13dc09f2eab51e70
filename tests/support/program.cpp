#include "support/program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "support/places.h"

namespace jnd::test_support {
namespace {

std::vector<std::string> environment_of(const ProgramOptions& options) {
  std::vector<std::string> all;
  for (char** entry = ::environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    bool hidden = text.starts_with("DISPLAY=") || text.starts_with("WAYLAND_DISPLAY=") ||
                  text.starts_with("JND_SHARE=");
    for (const auto& [name, value] : options.environment) {
      hidden = hidden || text.starts_with(name + "=");
    }
    if (!hidden) all.push_back(text);
  }
  for (const auto& [name, value] : options.environment) all.push_back(name + "=" + value);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments,
                               const ProgramOptions& options) {
  std::vector<std::string> words = options.wrapper;
  words.push_back(options.program.empty() ? program_file().string() : options.program);
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = environment_of(options);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  out_ = pipe[0];
  err_ = ::memfd_create("stderr", MFD_CLOEXEC);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  if (options.out_file.empty()) {
    posix_spawn_file_actions_adddup2(&actions, pipe[1], 1);
  } else {
    posix_spawn_file_actions_addopen(&actions, 1, options.out_file.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
  }
  posix_spawn_file_actions_adddup2(&actions, err_, 2);
  if (!options.folder.empty()) {
    posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());
  }
  // The process that runs the tests may ignore some signals. A shell, for example, may ignore
  // those of the keyboard.
  sigset_t every;
  ::sigfillset(&every);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &every);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int refused =
      ::posix_spawnp(&pid_, words.front().c_str(), &actions, &attributes,
                     pointers_to(words).data(), pointers_to(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  if (refused != 0) {
    pid_ = -1;
    throw std::runtime_error("cannot start " + words.front());
  }
}

RunningProgram::~RunningProgram() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  stop_reading();
  ::close(err_);
}

void RunningProgram::stop_reading() {
  if (out_ >= 0) ::close(out_);
  out_ = -1;
}

bool RunningProgram::read_more() {
  if (out_ < 0) return false;
  std::array<char, 65536> bytes;
  ssize_t count = 0;
  do {
    count = ::read(out_, bytes.data(), bytes.size());
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  buffer_.append(bytes.data(), static_cast<std::size_t>(count));
  return true;
}

std::optional<std::string> RunningProgram::read_line() {
  while (true) {
    if (const auto end = buffer_.find('\n'); end != std::string::npos) {
      std::string line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return line;
    }
    if (!read_more()) return std::nullopt;
  }
}

bool RunningProgram::has_ended() const {
  siginfo_t ended{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         ended.si_pid == pid_;
}

void RunningProgram::send_signal(int number) const { ::kill(pid_, number); }

ProgramOutcome RunningProgram::wait() {
  while (read_more()) {
  }
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  ProgramOutcome outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  outcome.out = std::move(buffer_);
  std::array<char, 4096> bytes;
  ::lseek(err_, 0, SEEK_SET);
  for (ssize_t count = 0; (count = ::read(err_, bytes.data(), bytes.size())) > 0;) {
    outcome.err.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return outcome;
}

ProgramOutcome run_program(const std::vector<std::string>& arguments,
                           const ProgramOptions& options) {
  return RunningProgram(arguments, options).wait();
}

std::string installed_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (std::filesystem::exists(file)) return file.string();
  }
  return "";
}

}  // namespace jnd::test_support
