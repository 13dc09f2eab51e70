#include "app/session/machine_checks.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <set>
#include <thread>

#include "app/session/found_ports.h"
#include "app/session/shipped_files.h"
#include "app/session/sleep_inhibitor.h"

namespace jnd::app {
namespace {

constexpr const char* kLimits = "/etc/security/limits.d/jnd.conf";

std::string join_group(const char* limit) {
  return std::string("run `sudo jnd doctor --fix` and log in again: it puts \"@jnd - ") +
         limit + "\" into " + kLimits + " and has you join the group jnd";
}

std::string words_of_limit(int resource, std::int64_t unit) {
  rlimit limit{};
  ::getrlimit(static_cast<__rlimit_resource>(resource), &limit);
  if (limit.rlim_cur == RLIM_INFINITY) return "unlimited";
  return std::to_string(static_cast<std::int64_t>(limit.rlim_cur) / unit);
}

/// The first line of a file of the system; "" if it cannot be read.
std::string line_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

MachineCheck kernel() {
  utsname name{};
  ::uname(&name);
  const std::string version = name.version;
  const bool realtime =
      line_of("/sys/kernel/realtime") == "1" || version.find("PREEMPT_RT") != std::string::npos;
  const bool dynamic = version.find("PREEMPT_DYNAMIC") != std::string::npos;
  const bool full =
      line_of("/sys/kernel/debug/sched/preempt").find("(full)") != std::string::npos ||
      line_of("/proc/cmdline").find("preempt=full") != std::string::npos;
  const bool preempts = version.find("PREEMPT") != std::string::npos;
  const bool ok = realtime || (preempts && (!dynamic || full));
  const char* found = realtime          ? "PREEMPT_RT"
                      : dynamic && full ? "PREEMPT_DYNAMIC, full"
                      : dynamic         ? "PREEMPT_DYNAMIC, not known to be full"
                      : preempts        ? "PREEMPT"
                                        : "no preemption of the kernel";
  return {"kernel", ok, found,
          ok ? "" : "boot with preempt=full, or install linux-image-rt-amd64"};
}

MachineCheck timers() {
  timespec resolution{.tv_sec = 1, .tv_nsec = 0};
  ::clock_getres(CLOCK_MONOTONIC, &resolution);
  const bool ok = resolution.tv_sec == 0 && resolution.tv_nsec <= 1000;
  std::string found = ok ? std::to_string(resolution.tv_nsec) + " ns" : "coarser than 1 us";
  const std::string source =
      line_of("/sys/devices/system/clocksource/clocksource0/current_clocksource");
  if (!source.empty()) found += ", clock " + source;
  return {"timer resolution", ok, found,
          ok ? "" : "boot without highres=off, with a kernel that has high-resolution timers"};
}

MachineCheck cpu_governor() {
  std::set<std::string> governors;
  std::error_code error;
  for (const auto& entry :
       std::filesystem::directory_iterator("/sys/devices/system/cpu/cpufreq", error)) {
    const std::string governor = line_of(entry.path() / "scaling_governor");
    if (!governor.empty()) governors.insert(governor);
  }
  std::string found;
  for (const std::string& governor : governors) {
    found += (found.empty() ? "" : ", ") + governor;
  }
  const bool ok = governors.empty() || governors == std::set<std::string>{"performance"};
  return {"cpu governor", ok, found.empty() ? "none that can be read" : found,
          ok ? "" : "run `sudo jnd doctor --fix`, or: cpupower frequency-set -g performance"};
}

/// The device file is only opened here; what it is asked for lasts as long as it is open.
MachineCheck idle_states() {
  const int file = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  const bool ok = file >= 0;
  if (ok) ::close(file);
  return {"idle states", ok,
          ok ? "can be kept away while the loop runs" : "cannot be kept away",
          ok ? ""
             : "run `sudo jnd doctor --fix` and log in again: it lets the group jnd write to "
               "/dev/cpu_dma_latency"};
}

MachineCheck processors() {
  const unsigned int count = std::thread::hardware_concurrency();
  return {"processors", count >= 2, std::to_string(count),
          count >= 2 ? "" : "use a machine with two cores or more: one is for the haptic loop"};
}

MachineCheck disk_space() {
  const double free_gb = free_bytes(".").value_or(0.0) / 1e9;
  char text[48];
  std::snprintf(text, sizeof text, "%.1f GB free here", free_gb);
  return {"disk space", free_gb >= 2.0, text,
          free_gb >= 2.0 ? "" : "free 2 GB: an hour of recording takes up to 60 MB a session"};
}

MachineCheck display() {
  const bool ok =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  return {"display", ok, ok ? "found" : "none",
          ok ? "" : "start from a desktop, or use the commands that need no window"};
}

MachineCheck shipped_files() {
  const std::filesystem::path folder = shipped_folder();
  std::error_code error;
  const bool ok = std::filesystem::is_directory(folder / "protocols", error);
  return {"shipped studies", ok, ok ? "found" : "none in " + folder.string(),
          ok ? "" : "set JND_SHARE to the folder that holds protocols/ and data/"};
}

/// Checks the ports for pulses and the devices that answer by a press. Nobody knows here which
/// input device is a pedal, and a keyboard that nobody else may read is as it should be.
MachineCheck ports() {
  int num_ports = 0, num_inputs = 0, num_read = 0;
  std::string closed, groups;
  for (const FoundPort& port : found_ports()) {
    if (port.kind == FoundPort::Kind::kInput) {
      ++num_inputs;
      num_read += port.may_use ? 1 : 0;
      continue;
    }
    ++num_ports;
    if (port.may_use) continue;
    closed += (closed.empty() ? "" : ", ") + port.path.string();
    const std::string group = group_of(port.kind);
    if (groups.find(group) == std::string::npos)
      groups += (groups.empty() ? "" : " and ") + group;
  }
  char text[96];
  std::snprintf(text, sizeof text, "%d ports; %d of %d input devices may be read", num_ports,
                num_read, num_inputs);
  return {"ports and pedals", closed.empty(),
          text + (closed.empty() ? std::string() : "; not allowed: " + closed),
          closed.empty() ? ""
                         : "`jnd doctor --fix` lets who sits at the machine use them; from "
                           "elsewhere, join the group " +
                               groups};
}

}  // namespace

MachineCheck check_realtime_priority() {
  sched_param before{};
  int policy = SCHED_OTHER;
  pthread_getschedparam(pthread_self(), &policy, &before);
  sched_param wanted{.sched_priority = 80};
  const bool ok = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted) == 0;
  if (ok) pthread_setschedparam(pthread_self(), policy, &before);
  return {"real-time priority", ok,
          std::string(ok ? "SCHED_FIFO 80" : "SCHED_FIFO 80 refused") + "; limit rtprio " +
              words_of_limit(RLIMIT_RTPRIO, 1),
          ok ? "" : join_group("rtprio 95")};
}

MachineCheck check_memory_lock() {
  const bool ok = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  if (ok) ::munlockall();
  return {"memory lock", ok,
          std::string(ok ? "mlockall works" : "mlockall refused") + "; limit memlock " +
              words_of_limit(RLIMIT_MEMLOCK, 1024) + " kB",
          ok ? "" : join_group("memlock unlimited")};
}

MachineCheck check_sleep() {
  const bool ok = SleepInhibitor().is_held();
  return {"sleep", ok,
          ok ? "kept away while a session runs" : "cannot be kept away: no systemd-inhibit",
          ok ? "" : "switch off automatic suspend, and leave the lid open"};
}

std::vector<MachineCheck> machine_checks() {
  return {check_realtime_priority(),
          check_memory_lock(),
          kernel(),
          timers(),
          cpu_governor(),
          idle_states(),
          check_sleep(),
          processors(),
          disk_space(),
          display(),
          ports(),
          shipped_files()};
}

std::optional<double> free_bytes(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(path, error);
  while (!std::filesystem::exists(there, error) && there != there.parent_path()) {
    there = there.parent_path();
  }
  const std::filesystem::space_info space = std::filesystem::space(there, error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available);
}

}  // namespace jnd::app
