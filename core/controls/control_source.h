#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/controls/control.h"

namespace jnd::core {

/// A device that is open and can be pressed. Used by one thread. Not real time.
class ControlSource {
 public:
  virtual ~ControlSource() = default;
  /// As in `Control`.
  [[nodiscard]] virtual const std::string& device() const noexcept = 0;
  /// Becomes readable where there is something to take.
  [[nodiscard]] virtual int descriptor() const noexcept = 0;
  /// What was pressed since; waits for nothing. Throws `Error` where the device is gone.
  [[nodiscard]] virtual std::vector<ControlEvent> take() = 0;
  /// Nobody else gets what is pressed; or others do again. Waits until nothing is held, so that
  /// nobody is left with a key that never comes up: false then, to be tried again. Throws
  /// `Error` where another program has the device for itself.
  [[nodiscard]] virtual bool take_for_ourselves(bool wanted) = 0;
  /// It has the keys of a whole keyboard. So have many pedals.
  [[nodiscard]] virtual bool is_keyboard() const noexcept { return false; }
};

/// An input device of the kernel, as the folder of devices lists it.
struct InputDevice {
  std::filesystem::path path;  ///< "/dev/input/event3"
  std::string name;            ///< As the kernel has it; its file's name where it says nothing.
  bool can_read = false;       ///< This user may.
};

/// Every input device, in the order of their numbers. Empty where the folder is not there.
[[nodiscard]] std::vector<InputDevice> input_devices(
    const std::filesystem::path& folder = "/dev/input");

/// Opens one by evdev, with times of CLOCK_MONOTONIC; nullptr for what nobody answers by: mice,
/// touch screens and pads, and devices without keys. Throws `Error` where it cannot be opened;
/// it says which group may.
[[nodiscard]] std::unique_ptr<ControlSource> open_input_device(
    const std::filesystem::path& path);

/// A box that sends a byte when something is pressed, at this rate: each value of a byte is a
/// control. Throws as `SerialPort`.
[[nodiscard]] std::unique_ptr<ControlSource> open_serial_box(const std::filesystem::path& path,
                                                             int baud);

}  // namespace jnd::core
