#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::core {

/// Returns the time by the clock of streams: CLOCK_MONOTONIC, in seconds, which recordings use
/// as well.
[[nodiscard]] double stream_clock_s() noexcept;

/// Where streams are looked for and offered. The numbers are those of all programs that speak
/// the protocol.
struct StreamNetwork {
  /// Outlets listen here for programs that look for streams.
  std::uint16_t search_port = 16571;
  /// First port that an outlet tries for itself; it tries the next `num_ports` as well.
  std::uint16_t first_port = 16572;
  int num_ports = 32;
  /// Addresses to which questions for all outlets go.
  std::vector<std::string> groups = {"127.0.0.1", "255.255.255.255", "224.0.0.1", "224.0.0.183",
                                     "239.255.172.215"};
  /// Machines that are asked individually, if groups do not reach them.
  std::vector<std::string> peers;
  int num_hops = 24;                                 ///< Network hops that a question may take.
  std::string session_id = "default";                ///< Only streams with this id are found.
  std::function<double()> clock_s = stream_clock_s;  ///< Our clock.
};

/// An address in an IPv4 network, as numbers in the machine's byte order.
struct StreamAddress {
  std::uint32_t host = 0;
  std::uint16_t port = 0;

  friend bool operator==(const StreamAddress&, const StreamAddress&) = default;
};
/// Returns a text such as "192.168.1.2".
[[nodiscard]] std::string host_text(const StreamAddress& address);
/// Reads such a text. Returns none for another text.
[[nodiscard]] std::optional<StreamAddress> numeric_address(const std::string& host,
                                                           std::uint16_t port);
/// Asks the system for the name's address. Returns none if it does not know the name.
[[nodiscard]] std::optional<StreamAddress> named_address(const std::string& host,
                                                         std::uint16_t port);
/// Returns the addresses of this machine's active interfaces.
[[nodiscard]] std::vector<StreamAddress> own_addresses();
[[nodiscard]] std::string own_hostname();

/// A socket that never blocks and is closed with the object. Not real time.
class StreamSocket {
 public:
  StreamSocket() = default;
  explicit StreamSocket(int descriptor) noexcept : descriptor_(descriptor) {}
  StreamSocket(StreamSocket&& other) noexcept;
  StreamSocket& operator=(StreamSocket&& other) noexcept;
  ~StreamSocket();

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] bool is_open() const noexcept { return descriptor_ >= 0; }
  void close() noexcept;
  [[nodiscard]] std::uint16_t port() const noexcept;  ///< Returns 0 if it has none.

 private:
  int descriptor_ = -1;
};

// All of these throw `Error` in one sentence if the system cannot give a socket.

/// For datagrams, at a port that the system chooses.
[[nodiscard]] StreamSocket datagram_socket();
/// For datagrams, at the first free port of the network's, or otherwise at any port.
[[nodiscard]] StreamSocket service_socket(const StreamNetwork& network);
/// For questions to all outlets, at the port that every outlet of this machine shares.
[[nodiscard]] StreamSocket search_socket(const StreamNetwork& network);
/// For connections, at the first free port of the network's, or otherwise at any port.
[[nodiscard]] StreamSocket listening_socket(const StreamNetwork& network);
/// Begins a connection. `is_connected` tells when it is made.
[[nodiscard]] StreamSocket connecting_socket(const StreamAddress& to);
[[nodiscard]] bool is_connected(const StreamSocket& socket) noexcept;
/// Accepts a waiting connection, which may then transfer data at once. Returns a closed socket
/// if none waits.
[[nodiscard]] StreamSocket accepted_socket(const StreamSocket& listener) noexcept;

[[nodiscard]] bool send_datagram(const StreamSocket& socket, std::string_view bytes,
                                 const StreamAddress& to) noexcept;
/// Sends to all groups by every interface, and to all ports of every peer. It reports no
/// failure, because another way may succeed.
void send_search(const StreamSocket& socket, std::string_view bytes,
                 const StreamNetwork& network) noexcept;
/// The next datagram that has arrived; `receive_datagram` returns none if there is none.
struct ReceivedDatagram {
  std::string bytes;
  StreamAddress from;
};
[[nodiscard]] std::optional<ReceivedDatagram> receive_datagram(const StreamSocket& socket);

/// Returns the number of bytes sent, or none if the connection is gone.
[[nodiscard]] std::optional<std::size_t> send_bytes(const StreamSocket& socket,
                                                    std::string_view bytes) noexcept;
/// Returns the bytes that have arrived, or none if the connection is gone.
[[nodiscard]] std::optional<std::string> receive_bytes(const StreamSocket& socket);

/// Wakes a thread that waits in `poll`.
class StreamWake {
 public:
  StreamWake();
  void wake() const noexcept;
  void clear() const noexcept;
  [[nodiscard]] int descriptor() const noexcept { return socket_.descriptor(); }

 private:
  StreamSocket socket_;
};

}  // namespace jnd::core
