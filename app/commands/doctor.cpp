#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "app/commands/commands.h"
#include "app/json_text.h"
#include "app/share.h"

namespace jnd::app {
namespace {

struct Finding {
  const char* name;
  bool ok;
  std::string found;
  std::string remedy;  ///< What mends it; "" if nothing needs to be.
};

Finding realtime_priority() {
  sched_param before{};
  int policy = SCHED_OTHER;
  pthread_getschedparam(pthread_self(), &policy, &before);
  sched_param wanted{.sched_priority = 80};
  const bool ok = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted) == 0;
  if (ok) pthread_setschedparam(pthread_self(), policy, &before);
  return {"real-time priority", ok, ok ? "SCHED_FIFO 80" : "refused",
          ok ? ""
             : "add \"@realtime - rtprio 95\" to /etc/security/limits.d/realtime.conf, join "
               "the group realtime and log in again"};
}

Finding memory_lock() {
  const bool ok = ::mlockall(MCL_CURRENT) == 0;
  if (ok) ::munlockall();
  return {"memory lock", ok, ok ? "mlockall works" : "refused",
          ok ? ""
             : "add \"@realtime - memlock unlimited\" to /etc/security/limits.d/realtime.conf, "
               "join the group realtime and log in again"};
}

Finding processors() {
  const unsigned int count = std::thread::hardware_concurrency();
  return {"processors", count >= 2, std::to_string(count),
          count >= 2 ? "" : "use a machine with two cores or more: one is for the haptic loop"};
}

Finding disk_space() {
  std::error_code error;
  const auto space = std::filesystem::space(".", error);
  const double free_gb = error ? 0.0 : static_cast<double>(space.available) / 1e9;
  char text[48];
  std::snprintf(text, sizeof text, "%.1f GB free here", free_gb);
  return {"disk space", free_gb >= 2.0, text,
          free_gb >= 2.0 ? "" : "free 2 GB: an hour of recording takes up to 60 MB a session"};
}

Finding display() {
  const bool ok =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  return {"display", ok, ok ? "found" : "none",
          ok ? "" : "start from a desktop, or use the commands that need no window"};
}

Finding shipped_files() {
  const std::filesystem::path folder = share_folder();
  std::error_code error;
  const bool ok = std::filesystem::is_directory(folder / "protocols", error);
  return {"shipped studies", ok, ok ? "found" : "none in " + folder.string(),
          ok ? "" : "set JND_SHARE to the folder that holds protocols/ and data/"};
}

int run(bool as_json) {
  const std::vector<Finding> findings = {realtime_priority(), memory_lock(), processors(),
                                         disk_space(),        display(),     shipped_files()};
  if (as_json) {
    nlohmann::json checks = nlohmann::json::array();
    for (const Finding& finding : findings) {
      checks.push_back({{"name", finding.name},
                        {"ok", finding.ok},
                        {"found", finding.found},
                        {"remedy", finding.remedy}});
    }
    std::puts(json_text(nlohmann::json{{"checks", std::move(checks)}}).c_str());
    return kDone;
  }
  for (const Finding& finding : findings) {
    std::printf("%-5s %-20s %s\n", finding.ok ? "ok" : "lacks", finding.name,
                finding.found.c_str());
    if (!finding.ok) std::printf("      %-20s %s\n", "", finding.remedy.c_str());
  }
  return kDone;
}

}  // namespace

void add_doctor(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("doctor", "What this machine lacks, and what mends it");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "One JSON document on stdout");
  command->callback(
      [&invocation, as_json] { invocation.run = [as_json] { return run(*as_json); }; });
}

}  // namespace jnd::app
