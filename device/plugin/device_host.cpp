#include "device/plugin/device_host.h"

#include <sched.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "core/clock.h"
#include "core/error.h"
#include "device/adaptive_spin.h"
#include "device/plugin/driver_pages.h"
#include "device/plugin/driver_session.h"
#include "device/plugin/futex.h"
#include "device/realtime_report.h"

namespace jnd::device {
namespace {

using core::Fault;

constexpr std::int64_t kLookEvery_ns = 2'000'000;
/// Time for a driver to close after the program has ended.
constexpr std::int64_t kLastPatience_ns = 1'000'000'000;
/// These are below the priorities of the loop and its watchdog, so that a driver that never
/// sleeps cannot starve them.
constexpr int kDriverPriority = 79;
constexpr int kHostWatchPriority = 81;
/// Time for which it spins for the next question, as the loop does for its next tick.
constexpr std::int64_t kLongestSpin_ns = 200'000;

constexpr int kProgramIsGone = 1;
constexpr int kStartedByOthers = 2;

/// Whether the program has opened these files for its host. If not, something else has started
/// this process.
bool are_pages() noexcept {
  struct stat program {
  }, host{};
  return ::fstat(kProgramPageFile, &program) == 0 && ::fstat(kHostPageFile, &host) == 0 &&
         program.st_size == sizeof(ProgramPage) && host.st_size == sizeof(HostPage);
}

class DeviceHost {
 public:
  DeviceHost(const ProgramPage& program, HostPage& host)
      : program_(program),
        host_(host),
        order_(program.order),
        period_ns_(std::llround(1e9 / program.order.rate_hz)),
        spin_(kLongestSpin_ns, period_ns_) {}

  int run() noexcept {
    try {
      tell(DriverPhase::kLoading);
      DriverSession session(order_.file.data(), order_.options.data(), order_.rate_hz);
      report_.description = session.description();
      tell(DriverPhase::kDescribed);
      if (order_.only_describes != 0) return 0;
      const DeviceCapabilities can = capabilities_of(session.description(), order_.rate_hz,
                                                     order_.believes_simulated != 0);
      has_own_clock_ = can.has_own_clock;
      paces_loop_ = can.paces_loop;
      timeout_ns_ = std::llround(1e9 * command_timeout_s(order_.believes_simulated != 0));
      return run(session);
    } catch (const std::exception& error) {
      const std::string_view words = error.what();
      std::copy_n(words.begin(), std::min(words.size(), report_.problem.size() - 1),
                  report_.problem.begin());
      tell(DriverPhase::kFailed);
      return 0;
    }
  }

 private:
  int run(DriverSession& session) {
    std::thread watch([this, &session] { watch_over(session); });
    const auto end_watch = [&] {
      is_over_ = true;
      watch.join();
    };
    try {
      tell(DriverPhase::kOpening);
      session.open();
    } catch (...) {
      end_watch();
      throw;
    }
    report_.description = session.description();
    RealtimeReport ignored;
    obtain_scheduler(kDriverPriority, ignored);
    obtain_locked_memory(ignored);
    prefault_stack();
    tell(DriverPhase::kOpen);
    if (paces_loop_) {
      pace_until_the_end(session);
    } else {
      answer_until_the_end(session);
    }
    tell(DriverPhase::kClosing);
    session.close();
    tell(DriverPhase::kClosed);
    end_watch();
    return program_is_gone() ? kProgramIsGone : 0;
  }

  void tell(DriverPhase phase) noexcept {
    report_.phase = phase;
    host_.report.store(report_);
    futex_wake(host_.report.version());
  }

  [[nodiscard]] bool program_is_gone() const noexcept { return ::getppid() != order_.program; }

  void answer_until_the_end(DriverSession& session) noexcept {
    while (!program_is_gone()) {
      const std::uint32_t seen = program_.request.version().load(std::memory_order_acquire);
      DriverRequest request;
      if (program_.request.load(request)) {
        if (request.ends != 0) return;
        take_force(session, request);
        take_question(session, request);
      }
      wait_for_request(seen);
    }
  }

  /// If a device has a clock of its own, questions come once a period, and the force comes soon
  /// after the answer. Waking takes longer than answering, so this thread sleeps until shortly
  /// before the next question is due and then spins.
  void wait_for_request(std::uint32_t seen) noexcept {
    const std::atomic<std::uint32_t>& version = program_.request.version();
    if (has_own_clock_ && last_question_ns_ != 0) {
      constexpr std::int64_t kForceComesWithin_ns = 100'000;
      look_until(version, seen, last_question_ns_ + kForceComesWithin_ns);
      const std::int64_t due_ns = last_question_ns_ + period_ns_;
      const std::int64_t wake_up_ns = due_ns - spin_.length_ns();
      if (version.load(std::memory_order_acquire) == seen && monotonic_ns() < wake_up_ns) {
        futex_wait_until(version, seen, wake_up_ns);
        const std::int64_t late_ns = monotonic_ns() - wake_up_ns;
        if (late_ns > 0) spin_.woke_up_late_by(late_ns);
      }
      look_until(version, seen, due_ns + kForceComesWithin_ns);
    }
    futex_wait_until(version, seen, monotonic_ns() + kLookEvery_ns * 10);
  }

  /// The driver waits for its device. Each measurement is reported at once. Then the force that
  /// responds to it has half a period to come; a later one goes with the next measurement.
  void pace_until_the_end(DriverSession& session) noexcept {
    const auto half_a_period_ns = std::llround(0.5e9 / order_.rate_hz);
    while (!program_is_gone()) {
      answer(session, answer_.read_number + 1);
      const std::int64_t deadline_ns = monotonic_ns() + half_a_period_ns;
      DriverRequest request;
      while (true) {
        const std::uint32_t seen = program_.request.version().load(std::memory_order_acquire);
        if (program_.request.load(request) &&
            (request.ends != 0 || request.write_number > last_write_)) {
          break;
        }
        if (monotonic_ns() >= deadline_ns) break;
        futex_wait_until(program_.request.version(), seen, deadline_ns);
      }
      if (request.ends != 0) return;
      take_force(session, request);
    }
  }

  void take_force(DriverSession& session, const DriverRequest& request) noexcept {
    if (request.write_number <= last_write_) return;
    answer_.num_skipped += request.write_number - last_write_ - 1;
    last_write_ = request.write_number;
    core::PointVectors force_n;
    for (std::size_t i = 0; i < force_n.size(); ++i) {
      const auto& point = request.force_on_hand_n[i];
      force_n[i] = {point[0], point[1], point[2]};
    }
    last_command_ns_ = request.written_ns;
    // If the whole machine was held up, what waits here may be as old as the pause.
    if (is_too_old(request)) session.halt();
    write_fault_ = session.write(force_n);
    if (write_fault_ == Fault::kDeviceWriteFailed) session.words_of_failure(answer_.words);
    if (is_too_old(request)) session.halt();
    ++answer_.num_writes;
  }

  /// If time advances by writes alone, a force never becomes too old.
  [[nodiscard]] bool is_too_old(const DriverRequest& request) const noexcept {
    return has_own_clock_ && monotonic_ns() - request.written_ns >= timeout_ns_;
  }

  void take_question(DriverSession& session, const DriverRequest& request) noexcept {
    if (request.read_number <= answer_.read_number) return;
    answer(session, request.read_number);
  }

  void answer(DriverSession& session, std::uint64_t read_number) noexcept {
    last_question_ns_ = monotonic_ns();
    const Fault found = session.read(answer_.measured);
    if (found == Fault::kDeviceReadFailed || found == Fault::kNonFiniteState)
      session.words_of_failure(answer_.words);
    answer_.is_measured = found == Fault::kNone ? 1 : 0;
    answer_.fault = static_cast<std::uint32_t>(found != Fault::kNone ? found : write_fault_);
    answer_.read_number = read_number;
    host_.answer.store(answer_);
    futex_wake(host_.answer.version());
  }

  /// Runs in the other thread, whatever call the driver is stuck in.
  void watch_over(DriverSession& session) noexcept {
    RealtimeReport ignored;
    obtain_scheduler(kHostWatchPriority, ignored);
    std::uint32_t known_halts = program_.num_halts.load();
    std::optional<std::int64_t> gone_since_ns;
    std::int64_t last_halt_ns = 0;
    while (!is_over_) {
      futex_wait_until(program_.num_halts, known_halts, monotonic_ns() + kLookEvery_ns);
      const std::int64_t now_ns = monotonic_ns();
      if (const std::uint32_t halts = program_.num_halts.load(); halts != known_halts) {
        known_halts = halts;
        session.halt();
      }
      const bool is_gone = program_is_gone();
      const std::int64_t command_ns = last_command_ns_.load();
      const bool is_silent =
          command_ns != 0 && has_own_clock_ && now_ns - command_ns >= timeout_ns_;
      if ((is_gone || is_silent) && now_ns - last_halt_ns >= timeout_ns_) {
        last_halt_ns = now_ns;
        session.halt();
      }
      if (!is_gone) continue;
      if (!gone_since_ns) gone_since_ns = now_ns;
      if (now_ns - *gone_since_ns >= kLastPatience_ns) std::_Exit(kProgramIsGone);
    }
  }

  const ProgramPage& program_;
  HostPage& host_;
  const DriverOrder order_;
  const std::int64_t period_ns_;
  AdaptiveSpin spin_;
  std::int64_t last_question_ns_ = 0;  ///< When the last question was answered.
  DriverReport report_;
  DriverAnswer answer_;
  bool has_own_clock_ = true;
  bool paces_loop_ = false;
  std::int64_t timeout_ns_ = 0;
  std::uint64_t last_write_ = 0;
  Fault write_fault_ = Fault::kNone;
  std::atomic<std::int64_t> last_command_ns_{0};
  std::atomic<bool> is_over_{false};
};

}  // namespace

int run_device_host() noexcept {
  if (!are_pages()) return kStartedByOthers;
  // The signal only wakes what waits. It also comes when just a thread of the program has
  // ended, so `program_is_gone` decides.
  struct sigaction woken {};
  woken.sa_handler = [](int) {};
  ::sigaction(SIGTERM, &woken, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  try {
    const MappedPage program(kProgramPageFile, sizeof(ProgramPage), false);
    const MappedPage host(kHostPageFile, sizeof(HostPage), true);
    const auto& order = *static_cast<const ProgramPage*>(program.memory());
    if (order.order.version != kDriverPagesVersion) return kStartedByOthers;
    if (::getppid() != order.order.program) return kProgramIsGone;
    // The program keeps its other threads, and this one with them, off the loop's CPU. But what
    // answers the loop must not wait behind them.
    if (CPU_COUNT(&order.order.cpus) > 0) {
      (void)::sched_setaffinity(0, sizeof order.order.cpus, &order.order.cpus);
    }
    // The device is closed, so destructors that a vendor's library has registered are skipped.
    std::_Exit(DeviceHost(order, *static_cast<HostPage*>(host.memory())).run());
  } catch (const std::exception&) {
    return kStartedByOthers;
  }
}

}  // namespace jnd::device
