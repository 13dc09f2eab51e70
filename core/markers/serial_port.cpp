#include "core/markers/serial_port.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "core/error.h"

namespace jnd::core {
namespace {

constexpr int kMostWaitToWrite_ms = 100;

constexpr std::array<std::pair<int, speed_t>, 8> kBaudRates = {{{9600, B9600},
                                                                {19200, B19200},
                                                                {38400, B38400},
                                                                {57600, B57600},
                                                                {115200, B115200},
                                                                {230400, B230400},
                                                                {460800, B460800},
                                                                {921600, B921600}}};

[[noreturn]] void throw_port_error(const std::filesystem::path& path,
                                   const std::string& expected, const std::string& remedy) {
  throw Error(path.string() + ": expected " + expected + ", found `" + std::strerror(errno) +
              "`; " + remedy);
}

speed_t speed_of(const std::filesystem::path& path, int baud) {
  const auto* const found =
      std::ranges::find(kBaudRates, baud, [](const auto& row) { return row.first; });
  if (found != kBaudRates.end()) return found->second;
  throw Error(path.string() +
              ": expected 9600, 19200, 38400, 57600, 115200, 230400, 460800 or 921600 baud, "
              "found " +
              std::to_string(baud));
}

}  // namespace

OwnedDescriptor::~OwnedDescriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

OwnedDescriptor::OwnedDescriptor(OwnedDescriptor&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

OwnedDescriptor& OwnedDescriptor::operator=(OwnedDescriptor&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

OwnedDescriptor open_port(const std::filesystem::path& path, int flags, const char* group) {
  OwnedDescriptor opened(::open(path.c_str(), flags | O_CLOEXEC));
  if (opened.get() >= 0) return opened;
  throw_port_error(
      path, "a port that can be opened",
      errno == EACCES || errno == EPERM ? std::string("join the group ") + group +
                                              ", `jnd doctor --fix` says how, and log in again"
      : errno == EBUSY ? "close the program that has it"
                       : "look whether it is plugged in; `jnd devices` lists ports");
}

SerialPort::SerialPort(const std::filesystem::path& path, int baud)
    : path_(path), descriptor_(open_port(path, O_RDWR | O_NOCTTY | O_NONBLOCK, "dialout")) {
  const speed_t speed = speed_of(path, baud);
  termios settings{};
  if (::tcgetattr(descriptor(), &settings) != 0) {
    throw_port_error(path, "a serial port", "name another one; `jnd devices` lists them");
  }
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
  ::cfsetispeed(&settings, speed);
  ::cfsetospeed(&settings, speed);
  if (::tcsetattr(descriptor(), TCSANOW, &settings) != 0) {
    throw_port_error(path, "a port that takes its settings", "name another one");
  }
  ::ioctl(descriptor(), TIOCEXCL);
}

void SerialPort::write(std::uint8_t byte) const {
  pollfd ready{.fd = descriptor(), .events = POLLOUT, .revents = 0};
  ssize_t written = ::write(descriptor(), &byte, 1);
  if (written < 0 && errno == EAGAIN && ::poll(&ready, 1, kMostWaitToWrite_ms) > 0) {
    written = ::write(descriptor(), &byte, 1);
  }
  if (written != 1 || ::tcdrain(descriptor()) != 0) {
    throw_port_error(path_, "a port that takes bytes", "look at its cable");
  }
}

void SerialPort::set_line(int line, bool is_high) const {
  if (::ioctl(descriptor(), is_high ? TIOCMBIS : TIOCMBIC, &line) != 0) {
    throw_port_error(path_, "a serial port with the lines RTS and DTR",
                     "look at its cable, or send bytes");
  }
}

}  // namespace jnd::core
