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

// What the program and the process of a driver share: two pages. One side writes each page, and
// the other only reads it. So a library that writes where it should not reaches neither the
// program's memory nor what the program has sent. The pages hold numbers and no pointers.

namespace jnd::device {

/// Changes with anything below. Both sides are from one build.
inline constexpr std::uint32_t kDriverPagesVersion = 3;
/// File descriptors of the pages in the host.
inline constexpr int kProgramPageFile = 3;
inline constexpr int kHostPageFile = 4;

/// What a host has to do from its start on.
struct DriverOrder {
  std::uint32_t version = kDriverPagesVersion;
  std::uint32_t only_describes = 0;
  pid_t program = 0;  ///< The host must not outlive this process.
  std::uint32_t believes_simulated = 0;
  double rate_hz = 1000.0;
  /// CPUs on which the program could run before it reserved one for its loop.
  cpu_set_t cpus{};
  std::array<char, 4096> file{};     ///< Path of the driver, with a zero at the end.
  std::array<char, 1024> options{};  ///< Options of the driver, with a zero at the end.
};

/// Requests for writes, reads and the end. The newest one wins.
struct DriverRequest {
  std::uint64_t write_number = 0;  ///< From 1; an increase marks a new force.
  std::uint64_t read_number = 0;   ///< From 1; an increase asks for an answer.
  std::int64_t written_ns = 0;     ///< When the force was computed, by the monotonic clock.
  std::uint32_t ends = 0;          ///< Asks the host to close the device and end.
  std::array<std::array<double, 3>, JND_DEVICE_MAX_POINTS> force_on_hand_n{};
};

/// The answer to a request.
struct DriverAnswer {
  std::uint64_t read_number = 0;
  std::uint64_t num_writes = 0;   ///< Forces that were passed on.
  std::uint64_t num_skipped = 0;  ///< Forces that newer ones replaced.
  std::uint32_t fault = 0;        ///< `core::Fault`: why there is no measurement, or no force.
  std::uint32_t is_measured = 0;
  jnd_device_state measured{};
  /// The driver's words about its last failure, with a zero at the end.
  std::array<char, 128> words{};
};

/// The progress of a host.
enum class DriverPhase : std::uint32_t {
  kStarting,
  kLoading,    ///< dlopen and the description.
  kDescribed,  ///< The description is available.
  kOpening,
  kOpen,  ///< It answers requests.
  kClosing,
  kClosed,
  kFailed,  ///< `problem` says why.
};

struct DriverReport {
  std::uint32_t version = kDriverPagesVersion;
  DriverPhase phase = DriverPhase::kStarting;
  jnd_device_description description{};
  std::array<char, 512> problem{};
};

struct ProgramPage {
  DriverOrder order;  ///< Set before the host is started, and never changed.
  SharedSlot<DriverRequest> request;
  alignas(64) std::atomic<std::uint32_t> num_halts{0};  ///< A futex.
};

struct HostPage {
  SharedSlot<DriverReport> report;
  SharedSlot<DriverAnswer> answer;
};

/// A page of memory, mapped into this process. Not real time.
class MappedPage {
 public:
  /// Maps a file of this size and does not close it. Throws `core::Error`.
  MappedPage(int file, std::size_t size, bool writable);
  ~MappedPage();
  MappedPage(const MappedPage&) = delete;
  MappedPage& operator=(const MappedPage&) = delete;

  [[nodiscard]] void* memory() const noexcept { return memory_; }

 private:
  void* memory_;
  std::size_t size_;
};

/// Returns a file without a name, filled with zeros, whose size nobody can change. Throws
/// `core::Error`. Not real time.
[[nodiscard]] int make_page_file(const char* name, std::size_t size);

}  // namespace jnd::device
