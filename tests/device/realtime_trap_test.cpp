#include "realtime_trap.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <linux/futex.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdarg>
#include <mutex>
#include <shared_mutex>

#if !defined(JND_SANITIZED)
#define JND_TRAP
#endif

namespace {

thread_local std::size_t lock_count = 0;

/// Returns the C library's own function of this name. It uses no static local variable, whose
/// guard might be a lock.
template <typename Function>
Function* next(std::atomic<void*>& known, const char* name) {
  void* found = known.load(std::memory_order_relaxed);
  if (found == nullptr) {
    found = ::dlsym(RTLD_NEXT, name);
    known.store(found, std::memory_order_relaxed);
  }
  return reinterpret_cast<Function*>(found);
}

}  // namespace

#ifdef JND_TRAP
#define JND_COUNTED(name, parameters, arguments)         \
  int name parameters {                                  \
    static constinit std::atomic<void*> known{nullptr};  \
    ++lock_count;                                        \
    return next<int parameters>(known, #name) arguments; \
  }

// These functions are in the program itself, where the linker takes them before those of the C
// library.
extern "C" {
JND_COUNTED(pthread_mutex_lock, (pthread_mutex_t * lock), (lock))
JND_COUNTED(pthread_mutex_trylock, (pthread_mutex_t * lock), (lock))
JND_COUNTED(pthread_mutex_timedlock, (pthread_mutex_t * lock, const timespec* until),
            (lock, until))
JND_COUNTED(pthread_rwlock_rdlock, (pthread_rwlock_t * lock), (lock))
JND_COUNTED(pthread_rwlock_wrlock, (pthread_rwlock_t * lock), (lock))
JND_COUNTED(pthread_rwlock_tryrdlock, (pthread_rwlock_t * lock), (lock))
JND_COUNTED(pthread_rwlock_trywrlock, (pthread_rwlock_t * lock), (lock))
JND_COUNTED(pthread_spin_lock, (pthread_spinlock_t * lock), (lock))
JND_COUNTED(pthread_cond_wait, (pthread_cond_t * condition, pthread_mutex_t* lock),
            (condition, lock))
JND_COUNTED(pthread_cond_timedwait,
            (pthread_cond_t * condition, pthread_mutex_t* lock, const timespec* until),
            (condition, lock, until))
JND_COUNTED(pthread_cond_clockwait,
            (pthread_cond_t * condition, pthread_mutex_t* lock, clockid_t clock,
             const timespec* until),
            (condition, lock, clock, until))
JND_COUNTED(pthread_cond_signal, (pthread_cond_t * condition), (condition))
JND_COUNTED(pthread_cond_broadcast, (pthread_cond_t * condition), (condition))
JND_COUNTED(sem_wait, (sem_t * semaphore), (semaphore))
JND_COUNTED(sem_trywait, (sem_t * semaphore), (semaphore))
JND_COUNTED(sem_timedwait, (sem_t * semaphore, const timespec* until), (semaphore, until))
JND_COUNTED(sem_post, (sem_t * semaphore), (semaphore))

long syscall(long number, ...) noexcept {
  static constinit std::atomic<void*> known{nullptr};
  ++lock_count;
  va_list list;
  va_start(list, number);
  long arguments[6];
  for (long& argument : arguments) argument = va_arg(list, long);
  va_end(list);
  return next<long(long, ...)>(known, "syscall")(number, arguments[0], arguments[1],
                                                 arguments[2], arguments[3], arguments[4],
                                                 arguments[5]);
}
}
#endif

#if defined(JND_TRAP) && defined(__x86_64__) && defined(PR_SET_SYSCALL_USER_DISPATCH)
#define JND_TRAP_SYSTEM_CALLS
#endif

namespace jnd::test_support {
namespace {

#ifdef JND_TRAP
constexpr bool kTrap = true;
#else
constexpr bool kTrap = false;
#endif

std::int64_t page_faults() noexcept {
  rusage use{};
  getrusage(RUSAGE_THREAD, &use);
  return use.ru_minflt + use.ru_majflt;
}

#ifdef JND_TRAP_SYSTEM_CALLS
thread_local volatile char system_calls = SYSCALL_DISPATCH_FILTER_ALLOW;
thread_local volatile long caught_call = -1;

void on_system_call(int /*signal*/, siginfo_t* info, void* context) {
  // This must come first, because the return from here is a system call, too.
  system_calls = SYSCALL_DISPATCH_FILTER_ALLOW;
  caught_call = info->si_syscall;
  greg_t* registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const int errno_before = errno;
  const long result =
      ::syscall(info->si_syscall, registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
                registers[REG_R10], registers[REG_R8], registers[REG_R9]);
  registers[REG_RAX] = result == -1 ? -errno : result;
  errno = errno_before;
}

bool dispatch(bool on) noexcept {
  return ::prctl(PR_SET_SYSCALL_USER_DISPATCH, on ? PR_SYS_DISPATCH_ON : PR_SYS_DISPATCH_OFF,
                 0UL, 0UL, on ? &system_calls : nullptr) == 0;
}
#endif

}  // namespace

bool LockCounter::is_supported() noexcept { return kTrap; }
LockCounter::LockCounter() noexcept : at_start_(lock_count) {}
std::size_t LockCounter::locks() const noexcept { return lock_count - at_start_; }

#ifdef JND_TRAP_SYSTEM_CALLS
bool SystemCallTrap::is_supported() noexcept { return dispatch(true) && dispatch(false); }

SystemCallTrap::SystemCallTrap() noexcept {
  struct sigaction action {};
  action.sa_sigaction = on_system_call;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGSYS, &action, &before_);
  caught_call = -1;
  dispatch(true);
  system_calls = SYSCALL_DISPATCH_FILTER_BLOCK;
}

SystemCallTrap::~SystemCallTrap() {
  system_calls = SYSCALL_DISPATCH_FILTER_ALLOW;
  dispatch(false);
  ::sigaction(SIGSYS, &before_, nullptr);
}

std::optional<long> SystemCallTrap::first_call() noexcept {
  const long call = caught_call;
  return call < 0 ? std::nullopt : std::optional<long>(call);
}
#else
bool SystemCallTrap::is_supported() noexcept { return false; }
SystemCallTrap::SystemCallTrap() noexcept = default;
SystemCallTrap::~SystemCallTrap() = default;
std::optional<long> SystemCallTrap::first_call() noexcept { return std::nullopt; }
#endif

bool PageFaultCounter::is_supported() noexcept { return kTrap; }
PageFaultCounter::PageFaultCounter() noexcept : at_start_(page_faults()) {}
std::int64_t PageFaultCounter::faults() const noexcept { return page_faults() - at_start_; }

LockedMemory::LockedMemory() noexcept : locked_(::mlockall(MCL_CURRENT | MCL_FUTURE) == 0) {}
LockedMemory::~LockedMemory() {
  if (locked_) ::munlockall();
}

namespace {

constexpr const char* kSanitizer = "a sanitizer has these functions for itself";

TEST(LockCounter, SeesEveryKindOfLock) {
  if (!LockCounter::is_supported()) GTEST_SKIP() << kSanitizer;
  std::mutex mutex;
  std::shared_mutex shared_mutex;
  std::condition_variable condition;
  sem_t semaphore;
  ASSERT_EQ(::sem_init(&semaphore, 0, 1), 0);
  const LockCounter counter;
  mutex.lock();
  EXPECT_EQ(counter.locks(), 1U) << "mutex";
  mutex.unlock();
  shared_mutex.lock_shared();
  EXPECT_EQ(counter.locks(), 2U) << "shared mutex";
  shared_mutex.unlock_shared();
  EXPECT_EQ(::sem_wait(&semaphore), 0);
  EXPECT_EQ(counter.locks(), 3U) << "semaphore";
  condition.notify_one();
  EXPECT_GE(counter.locks(), 3U);
  {
    std::unique_lock lock(mutex);
    condition.wait_for(lock, std::chrono::nanoseconds(1));
  }
  EXPECT_GE(counter.locks(), 5U) << "condition";
  const std::size_t before = counter.locks();
  std::atomic<int> number{0};
  int expected = 1;
  (void)::syscall(SYS_futex, &number, FUTEX_WAIT_PRIVATE, expected, nullptr, nullptr, 0);
  EXPECT_EQ(counter.locks(), before + 1) << "futex, as atomics wait";
  ::sem_destroy(&semaphore);
}

TEST(LockCounter, IsSilentWhereThereIsNoLock) {
  if (!LockCounter::is_supported()) GTEST_SKIP() << kSanitizer;
  std::atomic<int> number{0};
  const LockCounter counter;
  for (int i = 0; i < 100; ++i) number.fetch_add(1);
  EXPECT_EQ(counter.locks(), 0U);
}

TEST(SystemCallTrap, CatchesTheFirstSystemCallAndCarriesItOut) {
  if (!SystemCallTrap::is_supported()) GTEST_SKIP() << "no dispatch of system calls here";
  std::optional<long> caught;
  pid_t parent = 0;
  {
    const SystemCallTrap trap;
    parent = ::getppid();
    (void)::getpid();
    caught = SystemCallTrap::first_call();
  }
  EXPECT_EQ(caught, SYS_getppid);
  EXPECT_EQ(parent, ::getppid());
}

TEST(SystemCallTrap, IsSilentWhereThereIsNoSystemCall) {
  if (!SystemCallTrap::is_supported()) GTEST_SKIP() << "no dispatch of system calls here";
  std::atomic<int> number{0};
  std::optional<long> caught;
  {
    const SystemCallTrap trap;
    for (int i = 0; i < 100; ++i) number.fetch_add(1);
    caught = SystemCallTrap::first_call();
  }
  EXPECT_EQ(caught, std::nullopt);
}

TEST(PageFaultCounter, SeesThePagesThatWereNotThere) {
  if (!PageFaultCounter::is_supported()) GTEST_SKIP() << kSanitizer;
  const std::size_t num_bytes = 16 * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* fresh =
      ::mmap(nullptr, num_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(fresh, MAP_FAILED);
  const PageFaultCounter counter;
  static_cast<volatile char*>(fresh)[0] = 1;
  EXPECT_GE(counter.faults(), 1);
  ::munmap(fresh, num_bytes);
}

}  // namespace
}  // namespace jnd::test_support
