#include "app/session/sleep_inhibitor.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>

namespace jnd::app {
namespace {

/// Starts the child. systemd-inhibit starts `cat` when it has the lock, so what comes back
/// shows that the lock is held.
pid_t start_child(int input, int output) noexcept {
  posix_spawn_file_actions_t files;
  if (::posix_spawn_file_actions_init(&files) != 0) return -1;
  posix_spawnattr_t attributes;
  pid_t child = -1;
  if (::posix_spawnattr_init(&attributes) == 0) {
    // A Ctrl-C at the terminal is meant for us: the machine must not sleep while we finish.
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    char name[] = "systemd-inhibit";
    char what[] = "--what=sleep:idle:handle-lid-switch";
    char who[] = "--who=jnd";
    char why[] = "--why=A hand is in the device";
    char mode[] = "--mode=block";
    char command[] = "cat";
    char* const arguments[] = {name, what, who, why, mode, command, nullptr};
    if (::posix_spawnp(&child, name, &files, &attributes, arguments, environ) != 0) child = -1;
    ::posix_spawnattr_destroy(&attributes);
  }
  ::posix_spawn_file_actions_destroy(&files);
  return child;
}

}  // namespace

SleepInhibitor::SleepInhibitor() noexcept {
  std::array<int, 2> in{}, out{};
  if (::pipe2(in.data(), O_CLOEXEC) != 0) return;
  if (::pipe2(out.data(), O_CLOEXEC) != 0) {
    ::close(in[0]);
    ::close(in[1]);
    return;
  }
  child_ = start_child(in[0], out[1]);
  ::close(in[0]);
  ::close(out[1]);
  input_ = in[1];
  constexpr int kPatience_ms = 1000;
  pollfd answer{.fd = out[0], .events = POLLIN, .revents = 0};
  char letter = 'j';
  // If the child has ended at once, nobody reads the pipe. That is an error here and must be no
  // signal.
  struct sigaction ignored {
  }, before{};
  ignored.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &ignored, &before);
  is_held_ = child_ > 0 && ::write(input_, &letter, 1) == 1 &&
             ::poll(&answer, 1, kPatience_ms) == 1 && ::read(out[0], &letter, 1) == 1;
  ::sigaction(SIGPIPE, &before, nullptr);
  ::close(out[0]);
}

/// Ends the child by ending its input, and kills it if it does not obey.
SleepInhibitor::~SleepInhibitor() {
  if (input_ >= 0) ::close(input_);
  if (child_ <= 0) return;
  constexpr int kMostWaits = 100;
  constexpr timespec kWait{.tv_sec = 0, .tv_nsec = 10'000'000};
  for (int i = 0; i < kMostWaits; ++i) {
    if (::waitpid(child_, nullptr, WNOHANG) != 0) return;
    ::nanosleep(&kWait, nullptr);
  }
  ::kill(-child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace jnd::app
