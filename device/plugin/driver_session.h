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

/// A loaded driver, with all checks between it and the rest of the program. Everything that it
/// says is checked. Every force that it gets is finite and within the limits that it described
/// and the slew, and zero while it is halted. This is the same in the driver's own process and
/// without one.
///
/// One thread may use it. Any thread may call `halt` and `is_halted`.
class DriverSession {
 public:
  /// Loads the driver and gets its description of its device. Throws `core::Error`. Not real
  /// time.
  DriverSession(const std::filesystem::path& file, std::string options, double rate_hz);
  ~DriverSession() { close(); }
  DriverSession(const DriverSession&) = delete;
  DriverSession& operator=(const DriverSession&) = delete;

  /// Returns the latest description. Serial and firmware are known once the device is open.
  /// Real time.
  [[nodiscard]] const jnd_device_description& description() const noexcept {
    return description_;
  }

  /// Throws `core::Error` with the driver's words. Not real time.
  void open();
  /// It may be called twice. Not real time.
  void close() noexcept;

  /// Reads the newest measurement. If the driver has nothing new, it is the one before, with
  /// the same `sample_number`. A time of the driver's own must increase with each measurement.
  /// Real time if the driver is.
  [[nodiscard]] core::Fault read(jnd_device_state& measured) noexcept;

  /// Passes on these forces, limited with the last measurement. A driver that does not accept
  /// them is halted. Real time if the driver is.
  [[nodiscard]] core::Fault write(const core::PointVectors& force_on_hand_n) noexcept;

  /// Copies the driver's words about its last call, which failed. For the thread that made the
  /// call. Real time if the driver is.
  void words_of_failure(std::array<char, 128>& words) noexcept;

  /// Sets zero force at once, until a `write` consists of zeros only. Any thread may call it,
  /// even while the driver is stuck in another call. Real time if the driver is.
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
  /// Threads inside of `halt`. There must be none when the device is closed.
  std::atomic<int> num_halting_{0};
  std::uint64_t num_writes_ = 0;
  std::optional<jnd_device_state> newest_;
  const char* problem_ = nullptr;  ///< Of the measurement that was refused last; or none.
  core::HapticState state_;        ///< `newest_`, as the loop has it.
};

}  // namespace jnd::device
