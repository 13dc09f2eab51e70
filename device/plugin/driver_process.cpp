#include "device/plugin/driver_process.h"

#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <new>

#include "core/error.h"
#include "core/require.h"
#include "device/haptic_device.h"
#include "device/plugin/driver_description.h"
#include "device/plugin/driver_library.h"
#include "device/plugin/futex.h"

namespace jnd::device {
namespace {

constexpr double kUsualOpening_s = 10.0;
constexpr std::int64_t kGlance_ns = 5'000'000;

std::int64_t deadline_after(double duration_s) {
  return monotonic_ns() + std::llround(1e9 * duration_s);
}

template <std::size_t kSize>
void put(const std::string& text, std::array<char, kSize>& into) {
  core::require(text.size() < kSize, "device plugin: length of path or options", "less", kSize);
  into = {};
  std::copy(text.begin(), text.end(), into.begin());
}

std::string seconds(double duration_s) {
  std::string words = std::to_string(duration_s);
  words.erase(words.find_last_not_of('0') + 1);
  if (words.back() == '.') words.pop_back();
  return words + " s";
}

std::string doing(DriverPhase phase) {
  switch (phase) {
    case DriverPhase::kStarting:
      return "starting";
    case DriverPhase::kLoading:
      return "loading it";
    case DriverPhase::kDescribed:
    case DriverPhase::kOpening:
      return "opening its device";
    case DriverPhase::kOpen:
      return "using its device";
    case DriverPhase::kClosing:
    case DriverPhase::kClosed:
    case DriverPhase::kFailed:
      return "ending";
  }
  return "doing something else";
}

std::string how_ended(int status) {
  if (WIFSIGNALED(status)) {
    return std::string("crashed (") + ::strsignal(WTERMSIG(status)) + ")";
  }
  return "ended by itself (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
}

/// Files 3 and 4 are the pages. The driver gets no other file that this program has open.
pid_t started(const std::filesystem::path& host, const std::string& driver, int program_page,
              int host_page) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  // The numbers are assigned through higher ones, because a page's own number may be 3 or 4.
  constexpr int kByWay = 100;
  posix_spawn_file_actions_adddup2(&files, program_page, kByWay);
  posix_spawn_file_actions_adddup2(&files, host_page, kByWay + 1);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", 0, 0);
  posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, kByWay, kProgramPageFile);
  posix_spawn_file_actions_adddup2(&files, kByWay + 1, kHostPageFile);
  posix_spawn_file_actions_addclosefrom_np(&files, kHostPageFile + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // The process has a group of its own, because what is typed at the terminal is for the
  // program, which ends the driver in order.
  posix_spawnattr_setflags(
      &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  std::string name = host.filename(), argument = driver;
  std::array<char*, 3> arguments = {name.data(), argument.data(), nullptr};
  pid_t process = -1;
  const int problem =
      ::posix_spawn(&process, host.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (problem == 0) return process;
  throw DeviceUnreachable(host.string() +
                          ": expected the program that runs drivers to start, "
                          "found: " +
                          std::strerror(problem) + "; install it anew");
}

}  // namespace

DriverProcess::File::~File() { ::close(number); }

DriverProcess::DriverProcess(Parameters parameters)
    : parameters_(std::move(parameters)),
      program_file_(make_page_file("jnd-program-page", sizeof(ProgramPage))),
      host_file_(make_page_file("jnd-host-page", sizeof(HostPage))),
      program_(program_file_.number, sizeof(ProgramPage), true),
      host_(host_file_.number, sizeof(HostPage), false) {
  core::require_positive(parameters_.load_patience_s, "load_patience_s");
  core::require_positive(parameters_.close_patience_s, "close_patience_s");
  new (program_.memory()) ProgramPage;
  CPU_ZERO(&cpus_);
  (void)::sched_getaffinity(0, sizeof cpus_, &cpus_);
}

jnd_device_description DriverProcess::describe() {
  start(true, false);
  const DriverReport report = wait_for(DriverPhase::kDescribed, parameters_.load_patience_s);
  end();
  return report.description;
}

jnd_device_description DriverProcess::open(bool believes_simulated) {
  start(false, believes_simulated);
  const DriverReport loaded = wait_for(DriverPhase::kDescribed, parameters_.load_patience_s);
  const double asked_s = loaded.description.open_timeout_s;
  const DriverReport report =
      wait_for(DriverPhase::kOpen, asked_s > 0.0 ? asked_s : kUsualOpening_s);
  return report.description;
}

void DriverProcess::start(bool only_describes, bool believes_simulated) {
  end();
  if (is_stuck_) {
    throw DeviceUnreachable(
        parameters_.place +
        ": expected the process of the driver to end, found it stuck in the "
        "system; look at the device, then start this program anew");
  }
  clear_pages();
  DriverOrder& order = program_page().order;
  order.only_describes = only_describes ? 1 : 0;
  order.believes_simulated = believes_simulated ? 1 : 0;
  order.program = ::getpid();
  order.rate_hz = parameters_.rate_hz;
  order.cpus = cpus_;
  put(parameters_.driver.string(), order.file);
  put(parameters_.options, order.options);
  process_ = started(parameters_.host, parameters_.driver.string(), program_file_.number,
                     host_file_.number);
}

/// Nobody else uses the pages, because the process before has ended.
void DriverProcess::clear_pages() {
  new (program_.memory()) ProgramPage;
  const MappedPage writable(host_file_.number, sizeof(HostPage), true);
  new (writable.memory()) HostPage;
}

/// What a broken driver may have written is treated as mere numbers.
DriverReport DriverProcess::wait_for(DriverPhase phase, double patience_s) {
  const std::int64_t deadline_ns = deadline_after(patience_s);
  DriverReport report;
  while (true) {
    const std::uint32_t seen = host_page().report.version().load(std::memory_order_acquire);
    // This is asked first, so that everything the process wrote before its end is there.
    const bool is_over = has_ended();
    if (host_page().report.load(report)) {
      report.problem.back() = '\0';
      if (report.phase == DriverPhase::kFailed) give_up(report.problem.data());
      if (report.phase >= phase && report.phase < DriverPhase::kFailed) break;
    }
    if (is_over) {
      give_up("expected a driver that can be used, found that its process " +
              how_ended(exit_status_) + " while " + doing(report.phase) +
              "; try the driver by itself, under a debugger");
    }
    const std::int64_t now_ns = monotonic_ns();
    if (now_ns >= deadline_ns) {
      give_up("expected a driver that comes to an end with " + doing(report.phase) +
              " within " + seconds(patience_s) +
              ", found that it does not; look at the device, or at the driver");
    }
    futex_wait_until(host_page().report.version(), seen,
                     std::min(deadline_ns, now_ns + kGlance_ns));
  }
  try {
    require_description(report.description);
  } catch (const core::Error& error) {
    give_up(error.what());
  }
  return report;
}

void DriverProcess::give_up(const std::string& what) {
  if (process_ > 0) ::kill(process_, SIGKILL);
  end();
  throw DeviceUnreachable(parameters_.place + ": " + what);
}

bool DriverProcess::has_ended() noexcept {
  if (process_ <= 0) return true;
  int status = 0;
  const pid_t ended = ::waitpid(process_, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
  exit_status_ = status;
  process_ = -1;
  return true;
}

std::string DriverProcess::words_of_end() const {
  if (process_ <= 0) return "";
  // It is left to be waited for.
  siginfo_t info{};
  if (::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
      info.si_pid != process_) {
    return "";
  }
  if (info.si_code == CLD_EXITED) {
    return "its process ended by itself (exit code " + std::to_string(info.si_status) + ")";
  }
  return std::string("its process crashed (") + ::strsignal(info.si_status) + ")";
}

void DriverProcess::end() noexcept {
  if (process_ <= 0) return;
  program_page().request.store({.ends = 1});
  futex_wake(program_page().request.version());
  constexpr double kOfKilled_s = 1.0;
  for (const double patience_s : {parameters_.close_patience_s, kOfKilled_s}) {
    const std::int64_t deadline_ns = deadline_after(patience_s);
    while (monotonic_ns() < deadline_ns) {
      if (has_ended()) return;
      const timespec glance{.tv_sec = 0, .tv_nsec = 500'000};
      ::nanosleep(&glance, nullptr);
    }
    ::kill(process_, SIGKILL);
  }
  is_stuck_ = true;
}

void DriverProcess::request(const DriverRequest& request, bool wakes) noexcept {
  program_page().request.store(request);
  if (wakes) futex_wake(program_page().request.version());
}

std::uint64_t DriverProcess::num_unanswered() const noexcept {
  DriverRequest asked;
  DriverAnswer answered;
  if (process_ <= 0 || !program_page().request.load(asked)) return 0;
  if (!host_page().answer.load(answered)) answered.read_number = 0;
  return asked.read_number - std::min(asked.read_number, answered.read_number);
}

void DriverProcess::wait_for_answer(std::uint32_t seen,
                                    std::int64_t deadline_ns) const noexcept {
  constexpr std::int64_t kLook_ns = 80'000;  // Most answers come within this time.
  look_until(host_page().answer.version(), seen,
             std::min(deadline_ns, monotonic_ns() + kLook_ns));
  futex_wait_until(host_page().answer.version(), seen, deadline_ns);
}

void DriverProcess::halt() noexcept {
  ++program_page().num_halts;
  futex_wake(program_page().num_halts);
}

}  // namespace jnd::device
