#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "device/plugin/jnd_device.h"

namespace jnd::device {

/// The functions of a driver's shared object, as `jnd_device.h` has them. What it loads is
/// never unloaded, for the threads of a vendor's library may outlive it. Not real time.
class DriverLibrary {
 public:
  /// Loads it and asks for its version. Throws `core::Error`: no shared object, a symbol that
  /// is missing, another version.
  explicit DriverLibrary(const std::filesystem::path& file);

  decltype(&jnd_device_describe) describe = nullptr;
  decltype(&jnd_device_open) open = nullptr;
  decltype(&jnd_device_read) read = nullptr;
  decltype(&jnd_device_write) write = nullptr;
  decltype(&jnd_device_halt) halt = nullptr;
  decltype(&jnd_device_close) close = nullptr;
  decltype(&jnd_device_error) error = nullptr;
};

/// Somebody else's text in a sentence of ours: one line, printable, not too long; "" stays.
[[nodiscard]] std::string text_in_sentence(const char* text);

}  // namespace jnd::device
