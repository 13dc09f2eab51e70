#include "app/operator/open_outside.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "app/language/words.h"

namespace jnd::app {

std::string open_outside(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return tr("{} is not there any more.", path.string());
  }
  // The shell ends after a moment of 0.1 s, and init adopts the program, so nobody waits for
  // it. A system without a program for the file ends within that moment. The path is absolute,
  // so it cannot be mistaken for an option.
  constexpr int kNoProgram = 9, kRefused = 8;
  std::string shell = "sh", command = "-c", name = "open",
              script = as_is(
                  "command -v xdg-open >/dev/null || exit 9; "
                  "setsid xdg-open \"$1\" </dev/null >/dev/null 2>&1 & "
                  "for i in 1 2; do sleep 0.05; "
                  "kill -0 $! 2>/dev/null || { wait $! || exit 8; exit 0; }; done; exit 0"),
              whole = std::filesystem::absolute(path).string();
  std::array<char*, 6> arguments = {shell.data(), command.data(), script.data(),
                                    name.data(),  whole.data(),   nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, "sh", nullptr, nullptr, arguments.data(), environ) != 0) {
    return tr("{} cannot be opened from here.", whole);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoProgram) {
    return tr("No program opens files here: expected xdg-open (Debian's xdg-utils). It is {}.",
              whole);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == kRefused) {
    return tr(
        "Nothing on this desktop opens {}. Install a program for such files, or open it on "
        "another machine.",
        whole);
  }
  return tr("{} cannot be opened from here.", whole);
}

}  // namespace jnd::app
