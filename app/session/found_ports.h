#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jnd::app {

/// A port for pulses, or a device with something to press, as the kernel lists it.
struct FoundPort {
  enum class Kind { kInput, kSerial, kParallel };
  Kind kind = Kind::kInput;
  std::filesystem::path path;  ///< Such as "/dev/input/event3" or "/dev/ttyUSB0".
  std::string name;            ///< The name of an input device; "" for a port.
  /// This user may read the input device, or write to the port.
  bool may_use = false;
};

/// "input", "serial" or "parallel".
[[nodiscard]] const char* kind_words(FoundPort::Kind kind) noexcept;
/// The group that may use it: "input", "dialout" or "lp".
[[nodiscard]] const char* group_of(FoundPort::Kind kind) noexcept;

/// Input devices, serial ports with hardware behind them, and parallel ports. `root` contains
/// dev and sys. Nothing is opened.
[[nodiscard]] std::vector<FoundPort> found_ports(const std::filesystem::path& root = "/");

}  // namespace jnd::app
