#pragma once

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace jnd::test_support {

/// Counts the locks and waits of this thread while it is alive: those of pthread's mutexes,
/// rwlocks, conditions, spinlocks and semaphores, of which std's are made, and those that go
/// through `syscall`, as the waits of std's atomics and semaphores do. Tries and locks that
/// would not have had to wait count, too.
class LockCounter {
 public:
  /// False under ASan and TSan, which own these functions: skip the test there.
  [[nodiscard]] static bool is_supported() noexcept;

  LockCounter() noexcept;
  LockCounter(const LockCounter&) = delete;
  LockCounter& operator=(const LockCounter&) = delete;

  [[nodiscard]] std::size_t locks() const noexcept;

 private:
  std::size_t at_start_;
};

/// Catches the first system call of this thread while it is alive, whoever makes it. The kernel
/// hands the call to a signal handler, which notes it and carries it out; later calls pass.
/// Only one may be alive in a program.
class SystemCallTrap {
 public:
  /// False where the kernel or the processor has no such dispatch, and under sanitizers.
  [[nodiscard]] static bool is_supported() noexcept;

  SystemCallTrap() noexcept;
  ~SystemCallTrap();
  SystemCallTrap(const SystemCallTrap&) = delete;
  SystemCallTrap& operator=(const SystemCallTrap&) = delete;

  /// The number of the first call, as in <sys/syscall.h>.
  [[nodiscard]] static std::optional<long> first_call() noexcept;

 private:
  struct sigaction before_ {};
};

/// Counts the page faults of this thread while it is alive, with and without the disk.
class PageFaultCounter {
 public:
  /// False under sanitizers, whose shadow memory is not there until it is used.
  [[nodiscard]] static bool is_supported() noexcept;

  PageFaultCounter() noexcept;
  PageFaultCounter(const PageFaultCounter&) = delete;
  PageFaultCounter& operator=(const PageFaultCounter&) = delete;

  [[nodiscard]] std::int64_t faults() const noexcept;

 private:
  std::int64_t at_start_;
};

/// Keeps all memory of the process in place while it lives, where that is allowed.
class LockedMemory {
 public:
  LockedMemory() noexcept;
  ~LockedMemory();
  LockedMemory(const LockedMemory&) = delete;
  LockedMemory& operator=(const LockedMemory&) = delete;

  [[nodiscard]] bool is_locked() const noexcept { return locked_; }

 private:
  bool locked_;
};

}  // namespace jnd::test_support
