#include "device/realtime_report.h"

#include <dirent.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace jnd::device {
namespace {

void add_lack(std::string& lacks, const std::string& sentence) {
  if (!lacks.empty()) lacks += "; ";
  lacks += sentence;
}

std::string words(int policy, int priority) {
  switch (policy) {
    case SCHED_FIFO:
      return "SCHED_FIFO " + std::to_string(priority);
    case SCHED_RR:
      return "SCHED_RR " + std::to_string(priority);
    case SCHED_OTHER:
      return "SCHED_OTHER";
    case SCHED_BATCH:
      return "SCHED_BATCH";
    case SCHED_IDLE:
      return "SCHED_IDLE";
    default:
      return "policy " + std::to_string(policy);
  }
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Calls `change(CPUs)` for every thread of this program but the calling one, and assigns the
/// remaining CPUs to the thread, if there are any.
template <typename Change>
void change_cpus_of_other_threads(Change&& change) noexcept {
  DIR* tasks = ::opendir("/proc/self/task");
  if (tasks == nullptr) return;
  const pid_t own = ::gettid();
  while (const dirent* entry = ::readdir(tasks)) {
    const auto thread = static_cast<pid_t>(std::atol(entry->d_name));
    cpu_set_t cpus;
    if (thread <= 0 || thread == own) continue;
    if (sched_getaffinity(thread, sizeof cpus, &cpus) != 0) continue;
    change(cpus);
    if (CPU_COUNT(&cpus) > 0) sched_setaffinity(thread, sizeof cpus, &cpus);
  }
  ::closedir(tasks);
}

}  // namespace

ThreadUse thread_use() noexcept {
  rusage use{};
  getrusage(RUSAGE_THREAD, &use);
  return {.num_page_faults = use.ru_minflt + use.ru_majflt,
          .cpu_time_s = seconds(use.ru_utime) + seconds(use.ru_stime)};
}

void obtain_scheduler(int priority, RealtimeReport& report) {
  if (priority > 0) {
    sched_param wanted{};
    wanted.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
    if (error != 0) {
      add_lack(report.lacks, "the real-time scheduler was refused (" +
                                 std::string(std::strerror(error)) +
                                 "): allow rtprio in /etc/security/limits.d");
    }
  }
  sched_param given{};
  int policy = SCHED_OTHER;
  pthread_getschedparam(pthread_self(), &policy, &given);
  // Timers of ordinary threads become as exact as possible. A real-time thread has exact timers
  // anyway.
  if (policy != SCHED_FIFO && policy != SCHED_RR) prctl(PR_SET_TIMERSLACK, 1UL);
  report.priority = given.sched_priority;
  report.scheduler = words(policy, given.sched_priority);
  report.realtime_scheduler =
      priority > 0 && policy == SCHED_FIFO && given.sched_priority == priority;
}

void obtain_locked_memory(RealtimeReport& report) {
  report.memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  if (report.memory_locked) return;
  add_lack(report.lacks, "memory could not be locked (" + std::string(std::strerror(errno)) +
                             "): allow memlock in /etc/security/limits.d");
}

void obtain_cpu(int cpu, RealtimeReport& report) {
  cpu_set_t cpus;
  if (cpu >= 0) {
    CPU_ZERO(&cpus);
    CPU_SET(cpu, &cpus);
    const int error = pthread_setaffinity_np(pthread_self(), sizeof cpus, &cpus);
    report.pinned = error == 0;
    if (error != 0) {
      add_lack(report.lacks, "CPU " + std::to_string(cpu) + " could not be had (" +
                                 std::strerror(error) + ")");
    }
  }
  report.cpus.clear();
  if (pthread_getaffinity_np(pthread_self(), sizeof cpus, &cpus) != 0) return;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(i, &cpus)) report.cpus.push_back(i);
  }
}

void prefault_stack() noexcept {
  volatile unsigned char pages[256 * 1024];
  for (std::size_t i = 0; i < sizeof pages; i += 1024) pages[i] = 0;
}

void flush_denormals() noexcept {
#if defined(__SSE2__)
  constexpr unsigned kFlushToZero = 0x8000;
  constexpr unsigned kDenormalsAreZero = 0x0040;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);
#elif defined(__aarch64__)
  constexpr std::uint64_t kFlushToZero = std::uint64_t{1} << 24;
  std::uint64_t control = 0;
  asm volatile("mrs %0, fpcr" : "=r"(control));
  asm volatile("msr fpcr, %0" ::"r"(control | kFlushToZero));
#endif
}

void AwakeCpus::obtain(RealtimeReport& report) noexcept {
  if (file_ < 0) file_ = ::open("/dev/cpu_dma_latency", O_RDWR | O_CLOEXEC);
  if (file_ < 0) return;
  const std::int32_t latency_us = 0;
  report.cpus_kept_awake =
      ::write(file_, &latency_us, sizeof latency_us) == ssize_t{sizeof latency_us};
  if (!report.cpus_kept_awake) release();
}

void AwakeCpus::release() noexcept {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void ClearedCpu::obtain(RealtimeReport& report) noexcept {
  cpu_set_t allowed;
  if (!report.realtime_scheduler || cpu_ >= 0) return;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0 || CPU_COUNT(&allowed) < 2) return;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(cpu, &allowed)) cpu_ = cpu;
  }
  change_cpus_of_other_threads([this](cpu_set_t& cpus) { CPU_CLR(cpu_, &cpus); });
  // The thread moves there now and is then free to move. A real-time thread stays where it is
  // as long as it may run there.
  cpu_set_t there;
  CPU_ZERO(&there);
  CPU_SET(cpu_, &there);
  sched_setaffinity(0, sizeof there, &there);
  sched_setaffinity(0, sizeof allowed, &allowed);
  report.cleared_cpu = cpu_;
}

void ClearedCpu::release() noexcept {
  if (cpu_ < 0) return;
  change_cpus_of_other_threads([this](cpu_set_t& cpus) { CPU_SET(cpu_, &cpus); });
  cpu_ = -1;
}

}  // namespace jnd::device
