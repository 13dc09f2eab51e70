#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace jnd::device {

/// What the system really granted to a thread, whatever was requested.
struct RealtimeReport {
  bool realtime_scheduler = false;  ///< SCHED_FIFO at the requested priority is in force.
  /// The scheduler in force: "SCHED_FIFO 80", "SCHED_OTHER", ...
  std::string scheduler;
  /// The priority in force, [1, 99]; 0 without a real-time scheduler.
  int priority = 0;
  bool memory_locked = false;  ///< All memory of the process, also what it will map later.
  /// Pinned to the requested CPU; false if none was requested.
  bool pinned = false;
  std::vector<int> cpus;         ///< CPUs on which the thread may run, ascending.
  bool cpus_kept_awake = false;  ///< Idle CPUs do not enter deep sleep.
  int cleared_cpu = -1;  ///< CPU from which the program's other threads are kept; -1 for none.
  /// What was requested and not granted, and how to get it; otherwise empty.
  std::string lacks;
};

/// What a thread has used. Real time.
struct ThreadUse {
  std::int64_t num_page_faults = 0;  ///< With and without disk access.
  double cpu_time_s = 0.0;
};

/// Returns the use of the calling thread since it began, by a system call. Real time.
[[nodiscard]] ThreadUse thread_use() noexcept;

// Each of these requests one thing for the calling thread and enters the result into `report`.
// Not real time.

/// Requests SCHED_FIFO at `priority` in [1, 99]; 0 requests nothing and reports the present
/// state.
void obtain_scheduler(int priority, RealtimeReport& report);
/// Locks the memory of the whole process; `munlockall` undoes it.
void obtain_locked_memory(RealtimeReport& report);
/// Pins the thread to this CPU; -1 requests nothing and reports the present state.
void obtain_cpu(int cpu, RealtimeReport& report);
/// Touches the stack that a loop may need, so that no page is missing later.
void prefault_stack() noexcept;
/// Makes this thread treat denormal numbers as zero from now on. Values that decay in a filter
/// while the hand rests would otherwise cost a hundred times as much time.
void flush_denormals() noexcept;

/// Keeps every CPU out of idle states from which it wakes slowly, during the object's life, by
/// requesting latency 0 at /dev/cpu_dma_latency. It costs electricity and no CPU time.
class AwakeCpus {
 public:
  AwakeCpus() = default;
  ~AwakeCpus() { release(); }
  AwakeCpus(const AwakeCpus&) = delete;
  AwakeCpus& operator=(const AwakeCpus&) = delete;

  /// Does nothing if the device file is not writable, which does not count as lacking. Not real
  /// time.
  void obtain(RealtimeReport& report) noexcept;
  void release() noexcept;

 private:
  int file_ = -1;
};

/// During its life, it keeps all other threads of this program, and those that they start, off
/// one CPU, and moves the calling thread there. So drawing a window does not displace what the
/// loop's next tick needs from the cache. The thread is not pinned: if another program's loop
/// uses that CPU, the system may still move it.
class ClearedCpu {
 public:
  ClearedCpu() = default;
  ~ClearedCpu() { release(); }
  ClearedCpu(const ClearedCpu&) = delete;
  ClearedCpu& operator=(const ClearedCpu&) = delete;

  /// Takes the last of the CPUs on which the calling thread may run. It takes none if that is
  /// the only one, or if the thread has no real-time scheduler, without which it could not
  /// leave a busy CPU. Not real time.
  void obtain(RealtimeReport& report) noexcept;
  void release() noexcept;

 private:
  int cpu_ = -1;
};

}  // namespace jnd::device
