#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/hand.h"
#include "core/haptic_state.h"
#include "core/safety/fault.h"
#include "core/safety/force_limiter.h"
#include "device/halt_latch.h"
#include "device/plugin/driver_description.h"
#include "device/plugin/driver_library.h"

namespace jnd::device {

/// A driver that is loaded, and what stands between it and everybody else: whatever it says is
/// checked, and every force that it gets is finite, within the limits that it described and the
/// slew, and none while it is halted. The same in the driver's own process and without one.
///
/// One thread; `halt` and `is_halted` any.
class DriverSession {
 public:
  /// Loads the driver and has it describe its device. Throws `core::Error`. Not real time.
  DriverSession(const std::filesystem::path& file, std::string options, double rate_hz);
  ~DriverSession() { close(); }
  DriverSession(const DriverSession&) = delete;
  DriverSession& operator=(const DriverSession&) = delete;

  /// As it was last: serial and firmware are known once it is open. Real time.
  [[nodiscard]] const jnd_device_description& description() const noexcept {
    return description_;
  }

  /// Throws `core::Error` with what the driver says. Not real time.
  void open();
  /// May be called twice. Not real time.
  void close() noexcept;

  /// The newest measurement; where the driver has nothing new, the one before, and the same
  /// `sample_number`. A time of the driver's own must rise with each. Real time, as the driver.
  [[nodiscard]] core::Fault read(jnd_device_state& measured) noexcept;

  /// Passes on these forces, limited by what was measured last. A driver that does not take
  /// them is halted. Real time, as the driver.
  [[nodiscard]] core::Fault write(const core::PointVectors& force_on_hand_n) noexcept;

  /// What the driver says of its last call, which failed. By the thread that called it. Real
  /// time, as the driver.
  void words_of_failure(std::array<char, 128>& words) noexcept;

  /// Zero force at once, and until a `write` of nothing but zeros. Any thread; also while the
  /// driver is stuck in another call. Real time, as the driver.
  void halt() noexcept;

 private:
  [[nodiscard]] core::Fault check_newness(const jnd_device_state& measured) noexcept;
  [[nodiscard]] core::Fault pass_on(const core::PointVectors& force_on_hand_n) noexcept;

  DriverLibrary library_;
  std::string options_;
  double rate_hz_;
  jnd_device_description description_{};
  core::ForceLimiter limiter_;
  HaltLatch halt_;
  std::atomic<jnd_device*> device_{nullptr};
  std::atomic<int> num_halting_{0};  ///< Threads inside `halt`: none may be when it is closed.
  std::uint64_t num_writes_ = 0;
  std::optional<jnd_device_state> newest_;
  const char* problem_ = nullptr;  ///< Of the measurement that was refused last; or none.
  core::HapticState state_;        ///< `newest_`, as the loop has it.
};

}  // namespace jnd::device
