#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace jnd::test_support {

/// A serial port without hardware: the program opens `path`, and the test has the other end.
class PseudoTerminal {
 public:
  PseudoTerminal() : descriptor_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (descriptor_ < 0 || ::grantpt(descriptor_) != 0 || ::unlockpt(descriptor_) != 0) {
      throw std::runtime_error("no pseudo-terminal");
    }
    path_ = ::ptsname(descriptor_);
  }
  ~PseudoTerminal() { unplug(); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  /// Sends bytes, as a box does.
  void send(const std::vector<unsigned char>& bytes) const {
    if (::write(descriptor_, bytes.data(), bytes.size()) !=
        static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("the pseudo-terminal takes no bytes");
    }
  }
  /// Returns what the program has written: `count` bytes, or those that arrive within the time.
  [[nodiscard]] std::vector<unsigned char> received(std::size_t count,
                                                    int patience_ms = 5000) const {
    std::vector<unsigned char> bytes;
    while (bytes.size() < count) {
      pollfd waits{.fd = descriptor_, .events = POLLIN, .revents = 0};
      if (::poll(&waits, 1, patience_ms) <= 0) break;
      unsigned char byte = 0;
      if (::read(descriptor_, &byte, 1) != 1) break;
      bytes.push_back(byte);
    }
    return bytes;
  }
  /// Closes the port, as if its plug were pulled.
  void unplug() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

 private:
  int descriptor_;
  std::string path_;
};

}  // namespace jnd::test_support
