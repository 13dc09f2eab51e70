#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace jnd::core {

/// How a serial port carries a pulse.
enum class SerialMarker {
  /// The code is sent as a byte, for a box that turns it into lines; 0 ends the pulse.
  kBytes,
  kRts,  ///< The line RTS goes high; the code is lost.
  kDtr,  ///< The line DTR goes high; the code is lost.
};

/// Settings of a machine for pulses to another recorder; none by default. The meaning of the
/// codes belongs to the study (`MarkerCodes`).
struct WantedMarkers {
  std::string port;  ///< "/dev/ttyUSB0", or "/dev/parport0" for a parallel port; "" for none.
  SerialMarker serial = SerialMarker::kBytes;
  int baud = 115200;  ///< Rate for bytes.
  /// Duration of a pulse, and the pause before the next one, in [0, 0.1]. With 0 nothing ends a
  /// pulse, because the box does so itself.
  double width_s = 0.005;

  [[nodiscard]] bool any() const noexcept { return !port.empty(); }
};

/// A port that pulses are written to. There is one class for each kind of port, and one for
/// tests. Only one thread may use it. All functions throw `Error`. Not real time.
class MarkerPort {
 public:
  virtual ~MarkerPort() = default;
  /// Begins a pulse. When it returns, the code has left this program. `code` is not 0.
  virtual void set(std::uint8_t code) = 0;
  /// Ends the pulse.
  virtual void clear() = 0;
};

/// Throws `Error` for a port that is missing, that another program has, or that this user may
/// not write to; the message names the group that may.
[[nodiscard]] std::unique_ptr<MarkerPort> open_marker_port(const WantedMarkers& wanted);

/// Returns "bytes", "rts" or "dtr" for a serial port and "parallel" for a parallel one.
[[nodiscard]] std::string way_of(const WantedMarkers& wanted);

}  // namespace jnd::core
