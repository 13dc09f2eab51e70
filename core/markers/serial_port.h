#pragma once

#include <cstdint>
#include <filesystem>

namespace jnd::core {

/// Owns a file descriptor and closes it; -1 means none.
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

/// A serial port for raw bytes: 8 bits, no parity, one stop bit, no flow control, opened
/// exclusively. Nothing waits for a modem. Not real time.
class SerialPort {
 public:
  /// Throws `Error` if the port cannot be opened, or for a rate that no port has.
  SerialPort(const std::filesystem::path& path, int baud);

  [[nodiscard]] int descriptor() const noexcept { return descriptor_.get(); }
  /// Returns once the byte has left the kernel, as far as the driver knows. Throws `Error` if
  /// the port is gone or accepts nothing for 100 ms.
  void write(std::uint8_t byte) const;
  /// Sets the line TIOCM_RTS or TIOCM_DTR. Throws `Error` for a port without such lines.
  void set_line(int line, bool is_high) const;

 private:
  std::filesystem::path path_;
  OwnedDescriptor descriptor_;
};

/// Opens the file of a port. Throws `Error` if it cannot be opened; the message names `group`,
/// whose members may.
[[nodiscard]] OwnedDescriptor open_port(const std::filesystem::path& path, int flags,
                                        const char* group);

}  // namespace jnd::core
