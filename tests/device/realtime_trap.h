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
  /// Returns false under ASan and TSan, which replace these functions. Tests are skipped there.
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
  /// Returns false under sanitizers, and if the kernel or the processor cannot dispatch system
  /// calls.
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

/// While it is alive, counts the page faults of this thread, with and without the disk.
class PageFaultCounter {
 public:
  /// Returns false under sanitizers, whose shadow memory appears only when it is used.
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
