#include "app/commands/doctor_fix.h"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/usage_message.h"
#include "app/session/machine_fixes.h"
#include "app/session/shipped_files.h"

namespace jnd::app {
namespace {

std::string name_of_user(uid_t number) {
  const passwd* entry = ::getpwuid(number);
  return entry == nullptr ? "" : entry->pw_name;
}

/// The user who is going to run sessions, because root sets the machine up for somebody else.
std::string default_user() {
  if (::geteuid() != 0) return name_of_user(::getuid());
  if (const char* user = std::getenv("SUDO_USER"); user != nullptr) {
    return std::string(user) == "root" ? "" : user;
  }
  if (const char* number = std::getenv("PKEXEC_UID"); number != nullptr) {
    return name_of_user(static_cast<uid_t>(std::strtoul(number, nullptr, 10)));
  }
  return "";
}

/// Runs a command. Its output goes to stderr, and everybody can read the files that it makes.
int exit_code_of(const std::string& command) {
  std::fflush(stdout);
  const int status = std::system(("umask 022; { " + command + "; } >&2").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

nlohmann::ordered_json fixes_json(const std::vector<MachineFix>& fixes, bool changes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MachineFix& fix : fixes) {
    list.push_back({{"name", fix.name},
                    {"ok", fix.ok},
                    {"found", fix.found},
                    {"commands", fix.commands},
                    {"run", changes && !fix.commands.empty()},
                    {"remedy", fix.remedy}});
  }
  return {{"fixes", std::move(list)}};
}

void print_fixes(const std::vector<MachineFix>& fixes, const char* before_command) {
  for (const MachineFix& fix : fixes) {
    fmt::print("{:<5} {:<8} {}\n", fix.ok ? "ok" : "lacks", fix.name, fix.found);
    for (const std::string& command : fix.commands) {
      fmt::print("      {:<8} {}{}\n", "", before_command, command);
    }
    if (!fix.remedy.empty()) fmt::print("      {:<8} {}\n", "", fix.remedy);
  }
}

/// Runs all commands in turn, and stops at the first one that fails.
void mend(const std::vector<MachineFix>& fixes) {
  for (const MachineFix& fix : fixes) {
    for (const std::string& command : fix.commands) {
      const int code = exit_code_of(command);
      if (code == 0) continue;
      throw EnvironmentError(
          fmt::format("doctor: {}: expected `{}` to succeed, found exit code {}; what comes "
                      "before it is done, so mend what it says and run this again",
                      fix.name, command, code));
    }
  }
}

}  // namespace

int run_doctor_fix(const DoctorFixOptions& options) {
  FixedSystem system{.root = std::filesystem::canonical(options.root),
                     .shipped = std::filesystem::absolute(shipped_folder() / "data" / "system"),
                     .user = options.user.empty() ? default_user() : options.user};
  if (!options.user.empty() && !has_user(system, options.user)) {
    throw UsageError("--user: expected a user of this machine, found `" +
                     one_line(options.user.substr(0, 80)) +
                     "`; give the name by which somebody logs in");
  }
  const std::vector<MachineFix> fixes = machine_fixes(system);
  const bool lacks =
      std::ranges::any_of(fixes, [](const MachineFix& fix) { return !fix.commands.empty(); });
  const bool may_change = ::access((system.root / "etc").c_str(), W_OK) == 0;
  const bool changes = lacks && may_change && !options.dry_run;
  if (!options.json) {
    print_fixes(fixes, options.dry_run ? "would run: " : changes ? "runs: " : "as root: ");
  }
  if (changes) mend(fixes);
  if (options.json) {
    fmt::print("{}\n", json_text(fixes_json(fixes, changes)));
  } else if (options.dry_run) {
    fmt::print("Nothing was changed.\n");
  } else if (changes) {
    fmt::print("Done. Groups and limits are given at login: log out and in again.\n");
  } else if (!lacks) {
    fmt::print("Nothing is left to be given; `jnd doctor` tells the rest.\n");
  }
  if (lacks && !may_change && !options.dry_run) {
    throw EnvironmentError(
        "doctor: expected the rights of root to change this machine, found none, so nothing "
        "was changed; run the commands above as root, or `sudo jnd doctor --fix`");
  }
  return kDone;
}

}  // namespace jnd::app
