#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace jnd::device {

/// What a thread was really given, as the system says, whatever was asked for.
struct RealtimeReport {
  bool realtime_scheduler = false;  ///< SCHED_FIFO at the priority asked for is in force.
  std::string scheduler;            ///< In force: "SCHED_FIFO 80", "SCHED_OTHER", ...
  int priority = 0;                 ///< In force, [1, 99]; 0 if not a real-time one.
  bool memory_locked = false;       ///< All of the process, also what it will map.
  bool pinned = false;              ///< To the CPU asked for; false if none was.
  std::vector<int> cpus;            ///< Those the thread may run on, ascending.
  bool cpus_kept_awake = false;     ///< Idle CPUs do not fall asleep deeply.
  int cleared_cpu = -1;  ///< From which the program's other threads are kept; -1: none.
  std::string lacks;     ///< What was asked for and not given, and how to get it; else empty.
};

/// What a thread has used up. Real time.
struct ThreadUse {
  std::int64_t num_page_faults = 0;  ///< With and without the disk.
  double cpu_time_s = 0.0;
};

/// Of the calling thread since it began; a system call. Real time.
[[nodiscard]] ThreadUse thread_use() noexcept;

// Each asks for one thing on behalf of the calling thread, and enters into `report` what came
// of it. Not real time.

/// SCHED_FIFO at `priority` in [1, 99]; 0 asks for nothing and reports what there is.
void obtain_scheduler(int priority, RealtimeReport& report);
/// The whole process's memory; `munlockall` undoes it.
void obtain_locked_memory(RealtimeReport& report);
/// This CPU and no other; -1 asks for nothing and reports what there is.
void obtain_cpu(int cpu, RealtimeReport& report);
/// Touches the stack that a loop may need, so that no page is missing later.
void prefault_stack() noexcept;
/// Numbers too small to be normal count as zero from now on, in this thread: what dies away in
/// a filter of a hand at rest would cost a hundred times the time of any other.
void flush_denormals() noexcept;

/// Keeps every CPU out of the idle states that take long to wake up from, while it lives:
/// latency 0 asked for at /dev/cpu_dma_latency. Costs electricity and no one's CPU time.
class AwakeCpus {
 public:
  AwakeCpus() = default;
  ~AwakeCpus() { release(); }
  AwakeCpus(const AwakeCpus&) = delete;
  AwakeCpus& operator=(const AwakeCpus&) = delete;

  /// Not given where the device file is not writable, which is no lack. Not real time.
  void obtain(RealtimeReport& report) noexcept;
  void release() noexcept;

 private:
  int file_ = -1;
};

/// Keeps all other threads of this program, and what they start, off one CPU while it lives,
/// and moves the calling thread there: drawing a window costs no cache that the loop's next
/// tick needs. Not pinned: where another program's loop is on that CPU, the system still may
/// move this one.
class ClearedCpu {
 public:
  ClearedCpu() = default;
  ~ClearedCpu() { release(); }
  ClearedCpu(const ClearedCpu&) = delete;
  ClearedCpu& operator=(const ClearedCpu&) = delete;

  /// The last of the CPUs that the calling thread may run on; nothing where it is the only one,
  /// or the thread has no real-time scheduler to get away from a busy one. Not real time.
  void obtain(RealtimeReport& report) noexcept;
  void release() noexcept;

 private:
  int cpu_ = -1;
};

}  // namespace jnd::device
