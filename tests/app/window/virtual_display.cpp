#include "app/window/virtual_display.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace jnd::app {
namespace {

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_on(const std::string& display) {
  std::vector<std::string> all;
  for (char** entry = ::environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!text.starts_with("DISPLAY=")) all.push_back(text);
  }
  if (!display.empty()) all.push_back("DISPLAY=" + display);
  return all;
}

/// A child process, and the read end of what it writes to its descriptor `number`.
struct Child {
  pid_t pid = -1;
  int output = -1;
};

Child start(std::vector<std::string> words, const std::string& display, int number) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], number);
  if (number == STDOUT_FILENO) posix_spawn_file_actions_adddup2(&actions, pipe[1], 2);
  std::vector<std::string> environment = environment_on(display);
  Child child{.output = pipe[0]};
  if (::posix_spawnp(&child.pid, words.front().c_str(), &actions, nullptr,
                     pointers_to(words).data(), pointers_to(environment).data()) != 0) {
    child.pid = -1;
  }
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  return child;
}

std::string read_line(int descriptor) {
  std::string text;
  char letter = 0;
  for (;;) {
    const ssize_t count = ::read(descriptor, &letter, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0 || letter == '\n') return text;
    text += letter;
  }
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> bytes;
  for (;;) {
    const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

int wait_for(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

ToolOutcome run_tool(const std::vector<std::string>& words, const std::string& display) {
  const Child child = start(words, display, STDOUT_FILENO);
  ToolOutcome outcome;
  if (child.pid > 0) {
    outcome.out = read_all(child.output);
    outcome.exit_code = wait_for(child.pid);
  }
  ::close(child.output);
  return outcome;
}

void go_first() {
  (void)::setsid();
  (void)::setpriority(PRIO_PROCESS, 0, -10);
  // If every session gets the same share of the processor, niceness counts only within a
  // session.
  std::ofstream("/proc/self/autogroup") << "-15";
}

std::string what_windows_lack() {
  std::string lacking;
  for (const char* tool : {"Xvfb", "xdotool", "import"}) {
    if (!is_installed(tool)) lacking += (lacking.empty() ? "" : ", ") + std::string(tool);
  }
  return lacking.empty() ? "" : "not installed: " + lacking + "; `./dev setup` installs them";
}

VirtualDisplay::VirtualDisplay(int width_px, int height_px) {
  constexpr int kTellsItsName = 3;
  const std::string screen = std::to_string(width_px) + "x" + std::to_string(height_px) + "x24";
  const Child child =
      start({"Xvfb", "-displayfd", std::to_string(kTellsItsName), "-screen", "0", screen,
             "-nolisten", "tcp", "-noreset", "-ardelay", "250", "-arinterval", "40"},
            "", kTellsItsName);
  pid_ = child.pid;
  const std::string number = pid_ > 0 ? read_line(child.output) : "";
  ::close(child.output);
  if (number.empty()) {
    lose();
    throw std::runtime_error("Xvfb does not start");
  }
  name_ = ":" + number;
}

VirtualDisplay::~VirtualDisplay() { lose(); }

void VirtualDisplay::lose() {
  if (pid_ <= 0) return;
  // SIGTERM lets the server remove its lock and socket, before another server takes its number.
  ::kill(pid_, SIGTERM);
  wait_for(pid_);
  pid_ = -1;
}

}  // namespace jnd::app
