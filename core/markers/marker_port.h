#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace jnd::core {

/// How a serial port carries a pulse.
enum class SerialMarker {
  kBytes,  ///< The code is a byte, for a box that makes lines of it; 0 ends the pulse.
  kRts,    ///< The line RTS is high; the code is not seen.
  kDtr,    ///< The line DTR is high; likewise.
};

/// What a session is asked to tell another recorder by pulses; nothing unless somebody asks.
/// It belongs to the machine: which code says what belongs to the study (`MarkerCodes`).
struct WantedMarkers {
  std::string port;  ///< "/dev/ttyUSB0", or "/dev/parport0": a parallel port. "": none.
  SerialMarker serial = SerialMarker::kBytes;
  int baud = 115200;  ///< Of bytes.
  /// For how long a pulse is held, and how long the port rests before the next: [0, 0.1]. 0:
  /// nothing ends it, for the box does so by itself.
  double width_s = 0.005;

  [[nodiscard]] bool any() const noexcept { return !port.empty(); }
};

/// Where pulses go: one for each kind of port, and another for tests. Used by one thread. All
/// throw `Error`. Not real time.
class MarkerPort {
 public:
  virtual ~MarkerPort() = default;
  /// Begins a pulse: when it returns, the code has left this program. `code` is not 0.
  virtual void set(std::uint8_t code) = 0;
  /// Ends it.
  virtual void clear() = 0;
};

/// Throws `Error` for a port that is not there, that somebody else has, or that this user may
/// not write to; it says which group may.
[[nodiscard]] std::unique_ptr<MarkerPort> open_marker_port(const WantedMarkers& wanted);

/// "bytes", "rts", "dtr" of a serial port, "parallel" of the other.
[[nodiscard]] std::string way_of(const WantedMarkers& wanted);

}  // namespace jnd::core
