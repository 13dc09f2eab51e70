#pragma once

#include <cstdint>
#include <filesystem>

namespace jnd::core {

/// A file descriptor that is closed with it; -1: none.
class OwnedDescriptor {
 public:
  explicit OwnedDescriptor(int descriptor = -1) noexcept : descriptor_(descriptor) {}
  ~OwnedDescriptor();
  OwnedDescriptor(OwnedDescriptor&& other) noexcept;
  OwnedDescriptor& operator=(OwnedDescriptor&& other) noexcept;
  OwnedDescriptor(const OwnedDescriptor&) = delete;
  OwnedDescriptor& operator=(const OwnedDescriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return descriptor_; }

 private:
  int descriptor_;
};

/// A serial port for bytes as they are: 8 bits, no parity, one stop bit, no flow control, and
/// nobody else may open it. Nothing waits for a modem. Not real time.
class SerialPort {
 public:
  /// Throws `Error` where it cannot be opened, and for a rate that no port has.
  SerialPort(const std::filesystem::path& path, int baud);

  [[nodiscard]] int descriptor() const noexcept { return descriptor_.get(); }
  /// Returns once the byte has left the kernel, as far as the driver knows. Throws `Error`
  /// where the port is gone or takes nothing for 100 ms.
  void write(std::uint8_t byte) const;
  /// `line`: TIOCM_RTS or TIOCM_DTR. Throws `Error` for a port without such lines.
  void set_line(int line, bool is_high) const;

 private:
  std::filesystem::path path_;
  OwnedDescriptor descriptor_;
};

/// Opens a file of a port and throws `Error` in a sentence where it cannot be: `group` may.
[[nodiscard]] OwnedDescriptor open_port(const std::filesystem::path& path, int flags,
                                        const char* group);

}  // namespace jnd::core
