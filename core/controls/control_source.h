#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/controls/control.h"

namespace jnd::core {

/// An open device whose controls can be pressed. Only one thread may use it. Not real time.
class ControlSource {
 public:
  virtual ~ControlSource() = default;
  /// Returns the device's name as in `Control`.
  [[nodiscard]] virtual const std::string& device() const noexcept = 0;
  /// Returns a descriptor that is readable when `take` has something to return.
  [[nodiscard]] virtual int descriptor() const noexcept = 0;
  /// Returns what was pressed since the last call, without waiting. Throws `Error` if the
  /// device is gone.
  [[nodiscard]] virtual std::vector<ControlEvent> take() = 0;
  /// Takes the device exclusively, so that no other program gets its presses, or gives it back.
  /// While something is held it does nothing and returns false, so that no program is left with
  /// a key that never comes up; then try again. Throws `Error` if another program has the
  /// device exclusively.
  [[nodiscard]] virtual bool take_for_ourselves(bool wanted) = 0;
  /// Whether the device has the keys of a whole keyboard. Many pedals have.
  [[nodiscard]] virtual bool is_keyboard() const noexcept { return false; }
};

/// An input device of the kernel, as listed in the folder of devices.
struct InputDevice {
  std::filesystem::path path;  ///< "/dev/input/event3"
  /// The kernel's name for it, or the file's name if the kernel gives none.
  std::string name;
  bool can_read = false;  ///< Whether this user may read it.
};

/// Returns every input device, ordered by number. Returns none if the folder is missing.
[[nodiscard]] std::vector<InputDevice> input_devices(
    const std::filesystem::path& folder = "/dev/input");

/// Opens an input device by evdev, with times of CLOCK_MONOTONIC. Returns nullptr for devices
/// that nobody answers with: mice, touch screens and pads, and devices without keys. Throws
/// `Error` if it cannot be opened; the message names the group that may.
[[nodiscard]] std::unique_ptr<ControlSource> open_input_device(
    const std::filesystem::path& path);

/// Opens a box that sends a byte at this rate when something is pressed. Each value of a byte
/// is a control. Throws like `SerialPort`.
[[nodiscard]] std::unique_ptr<ControlSource> open_serial_box(const std::filesystem::path& path,
                                                             int baud);

}  // namespace jnd::core
