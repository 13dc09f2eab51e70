#pragma once

#include <sched.h>
#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/safety/fault.h"
#include "device/plugin/jnd_device.h"
#include "device/plugin/shared_slot.h"

// What the program and the process of a driver share: two pages, each written by one side and
// only read by the other, so that a library that writes where it should not reaches neither the
// program's memory nor what the program has said. Numbers, no pointers.

namespace jnd::device {

/// Changes with anything below: both sides are of one build.
inline constexpr std::uint32_t kDriverPagesVersion = 3;
/// Where a host finds the pages.
inline constexpr int kProgramPageFile = 3;
inline constexpr int kHostPageFile = 4;

/// What is wanted of a host from its start on.
struct DriverOrder {
  std::uint32_t version = kDriverPagesVersion;
  std::uint32_t only_describes = 0;
  pid_t program = 0;  ///< That it must not outlive.
  std::uint32_t believes_simulated = 0;
  double rate_hz = 1000.0;
  cpu_set_t cpus{};  ///< That the program might run on before it kept one free for its loop.
  std::array<char, 4096> file{};     ///< Of the driver, a zero behind it.
  std::array<char, 1024> options{};  ///< For the driver, likewise.
};

/// Newest wins: one for each write, each read, and the end.
struct DriverRequest {
  std::uint64_t write_number = 0;  ///< From 1 on; the force is new where it has risen.
  std::uint64_t read_number = 0;   ///< From 1 on; an answer is wanted where it has risen.
  std::int64_t written_ns = 0;     ///< When the force was computed, monotonic.
  std::uint32_t ends = 0;          ///< Close the device and go.
  std::array<std::array<double, 3>, JND_DEVICE_MAX_POINTS> force_on_hand_n{};
};

/// What became of a request.
struct DriverAnswer {
  std::uint64_t read_number = 0;
  std::uint64_t num_writes = 0;   ///< Forces that were passed on.
  std::uint64_t num_skipped = 0;  ///< Forces that were overtaken by newer ones.
  std::uint32_t fault = 0;        ///< `core::Fault`: why there is no measurement, or no force.
  std::uint32_t is_measured = 0;
  jnd_device_state measured{};
  std::array<char, 128> words{};  ///< Of the driver, when it failed last; a zero behind it.
};

/// How far a host has come.
enum class DriverPhase : std::uint32_t {
  kStarting,
  kLoading,    ///< dlopen, and the description.
  kDescribed,  ///< The description is there.
  kOpening,
  kOpen,  ///< Answers requests.
  kClosing,
  kClosed,
  kFailed,  ///< The problem says why.
};

struct DriverReport {
  std::uint32_t version = kDriverPagesVersion;
  DriverPhase phase = DriverPhase::kStarting;
  jnd_device_description description{};
  std::array<char, 512> problem{};
};

struct ProgramPage {
  DriverOrder order;  ///< Before the host is started; never after.
  SharedSlot<DriverRequest> request;
  alignas(64) std::atomic<std::uint32_t> num_halts{0};  ///< A futex.
};

struct HostPage {
  SharedSlot<DriverReport> report;
  SharedSlot<DriverAnswer> answer;
};

/// Memory in which a page lies, mapped into this process. Not real time.
class MappedPage {
 public:
  /// Of a file of this size, which is not closed. Throws `core::Error`.
  MappedPage(int file, std::size_t size, bool writable);
  ~MappedPage();
  MappedPage(const MappedPage&) = delete;
  MappedPage& operator=(const MappedPage&) = delete;

  [[nodiscard]] void* memory() const noexcept { return memory_; }

 private:
  void* memory_;
  std::size_t size_;
};

/// A file without a name, of zeros, whose size nobody can change any more. Throws
/// `core::Error`. Not real time.
[[nodiscard]] int make_page_file(const char* name, std::size_t size);

}  // namespace jnd::device
