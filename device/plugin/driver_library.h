#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "device/plugin/jnd_device.h"

namespace jnd::device {

/// The functions of a driver's shared object, as declared in `jnd_device.h`. It is never
/// unloaded, because the threads of a vendor's library may outlive it. Not real time.
class DriverLibrary {
 public:
  /// Loads the file and asks for its version. Throws `core::Error` if it is no shared object,
  /// lacks a symbol or has another version.
  explicit DriverLibrary(const std::filesystem::path& file);

  decltype(&jnd_device_describe) describe = nullptr;
  decltype(&jnd_device_open) open = nullptr;
  decltype(&jnd_device_read) read = nullptr;
  decltype(&jnd_device_write) write = nullptr;
  decltype(&jnd_device_halt) halt = nullptr;
  decltype(&jnd_device_close) close = nullptr;
  decltype(&jnd_device_error) error = nullptr;
};

/// Returns a foreign text in a form that fits into a sentence: one line, printable, not too
/// long. "" stays "".
[[nodiscard]] std::string text_in_sentence(const char* text);

}  // namespace jnd::device
