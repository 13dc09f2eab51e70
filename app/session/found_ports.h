#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jnd::app {

/// What can be pressed, and where pulses can go, as the kernel lists it.
struct FoundPort {
  enum class Kind { kInput, kSerial, kParallel };
  Kind kind = Kind::kInput;
  std::filesystem::path path;  ///< "/dev/input/event3", "/dev/ttyUSB0"
  std::string name;            ///< Of an input device; "" of a port.
  bool may_use = false;        ///< This user may read it, or write to a port.
};

/// "input", "serial", "parallel".
[[nodiscard]] const char* kind_words(FoundPort::Kind kind) noexcept;
/// The group that the system lets use such: "input", "dialout", "lp".
[[nodiscard]] const char* group_of(FoundPort::Kind kind) noexcept;

/// Input devices, serial ports that have hardware behind them, and parallel ports. `root` holds
/// dev and sys. Opens none of them.
[[nodiscard]] std::vector<FoundPort> found_ports(const std::filesystem::path& root = "/");

}  // namespace jnd::app
