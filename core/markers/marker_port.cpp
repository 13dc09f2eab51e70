#include "core/markers/marker_port.h"

#include <fcntl.h>
#include <linux/ppdev.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/markers/serial_port.h"

namespace jnd::core {
namespace {

class BytePort final : public MarkerPort {
 public:
  explicit BytePort(const WantedMarkers& wanted) : port_(wanted.port, wanted.baud) {}
  void set(std::uint8_t code) override { port_.write(code); }
  void clear() override { port_.write(0); }

 private:
  SerialPort port_;
};

/// Opening a serial port may raise its lines, so this class lowers them after opening.
class LinePort final : public MarkerPort {
 public:
  explicit LinePort(const WantedMarkers& wanted)
      : port_(wanted.port, wanted.baud),
        line_(wanted.serial == SerialMarker::kRts ? TIOCM_RTS : TIOCM_DTR) {
    clear();
  }
  void set(std::uint8_t) override { port_.set_line(line_, true); }
  void clear() override { port_.set_line(line_, false); }

 private:
  SerialPort port_;
  int line_;
};

/// Uses the eight data lines of a parallel port, by the kernel's ppdev.
class ParallelPort final : public MarkerPort {
 public:
  explicit ParallelPort(const std::string& path)
      : path_(path), descriptor_(open_port(path, O_RDWR, "lp")) {
    require(::ioctl(descriptor_.get(), PPCLAIM));
    clear();
  }
  ~ParallelPort() override { ::ioctl(descriptor_.get(), PPRELEASE); }
  ParallelPort(const ParallelPort&) = delete;
  ParallelPort& operator=(const ParallelPort&) = delete;
  void set(std::uint8_t code) override { require(::ioctl(descriptor_.get(), PPWDATA, &code)); }
  void clear() override { set(0); }

 private:
  void require(int result) const {
    if (result == 0) return;
    throw Error(path_ + ": expected a parallel port that takes codes, found `" +
                std::strerror(errno) +
                "`; close the program that has it (a printer's, as often as not)");
  }

  std::string path_;
  OwnedDescriptor descriptor_;
};

bool is_parallel(const std::string& port) {
  return port.substr(port.rfind('/') + 1).starts_with("parport");
}

}  // namespace

std::unique_ptr<MarkerPort> open_marker_port(const WantedMarkers& wanted) {
  if (is_parallel(wanted.port)) return std::make_unique<ParallelPort>(wanted.port);
  if (wanted.serial == SerialMarker::kBytes) return std::make_unique<BytePort>(wanted);
  return std::make_unique<LinePort>(wanted);
}

std::string way_of(const WantedMarkers& wanted) {
  if (is_parallel(wanted.port)) return "parallel";
  if (wanted.serial == SerialMarker::kBytes) return "bytes";
  return wanted.serial == SerialMarker::kRts ? "rts" : "dtr";
}

}  // namespace jnd::core
