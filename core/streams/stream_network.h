#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::core {

/// The clock that streams tell their times by: CLOCK_MONOTONIC, in seconds, which recordings
/// have as well.
[[nodiscard]] double stream_clock_s() noexcept;

/// Where streams are looked for and offered. The numbers are those of every other program that
/// speaks the protocol.
struct StreamNetwork {
  std::uint16_t search_port = 16571;  ///< Where outlets hear who looks for streams.
  std::uint16_t first_port = 16572;   ///< Of an outlet's own; the next `num_ports` are tried.
  int num_ports = 32;
  /// Where questions go that are for all.
  std::vector<std::string> groups = {"127.0.0.1", "255.255.255.255", "224.0.0.1", "224.0.0.183",
                                     "239.255.172.215"};
  /// Machines that are asked by themselves, where groups do not reach them.
  std::vector<std::string> peers;
  int num_hops = 24;                                 ///< That a question may take.
  std::string session_id = "default";                ///< Only streams of this one are found.
  std::function<double()> clock_s = stream_clock_s;  ///< Ours.
};

/// A place in a network of version 4, as numbers in our order.
struct StreamAddress {
  std::uint32_t host = 0;
  std::uint16_t port = 0;

  friend bool operator==(const StreamAddress&, const StreamAddress&) = default;
};
/// "192.168.1.2"
[[nodiscard]] std::string host_text(const StreamAddress& address);
/// Of such a text; none for another one.
[[nodiscard]] std::optional<StreamAddress> numeric_address(const std::string& host,
                                                           std::uint16_t port);
/// Asks the system for the name; none where it does not know it.
[[nodiscard]] std::optional<StreamAddress> named_address(const std::string& host,
                                                         std::uint16_t port);
/// Of this machine, by its interfaces that are up.
[[nodiscard]] std::vector<StreamAddress> own_addresses();
[[nodiscard]] std::string own_hostname();

/// A socket that never waits, closed with the object. Not real time.
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
  [[nodiscard]] std::uint16_t port() const noexcept;  ///< 0 where it has none.

 private:
  int descriptor_ = -1;
};

// All throw `Error` in one sentence where the system has none to give.

/// Datagrams from a port that nobody chose.
[[nodiscard]] StreamSocket datagram_socket();
/// Datagrams at the first free port of the network's, else at any.
[[nodiscard]] StreamSocket service_socket(const StreamNetwork& network);
/// Questions for all, at the port that every outlet of this machine shares.
[[nodiscard]] StreamSocket search_socket(const StreamNetwork& network);
/// Connections at the first free port of the network's, else at any.
[[nodiscard]] StreamSocket listening_socket(const StreamNetwork& network);
/// A connection that is still being made; `is_connected` says when.
[[nodiscard]] StreamSocket connecting_socket(const StreamAddress& to);
[[nodiscard]] bool is_connected(const StreamSocket& socket) noexcept;
/// One that waits to be accepted, and is allowed to speak at once; closed where none waits.
[[nodiscard]] StreamSocket accepted_socket(const StreamSocket& listener) noexcept;

[[nodiscard]] bool send_datagram(const StreamSocket& socket, std::string_view bytes,
                                 const StreamAddress& to) noexcept;
/// To all groups by every interface, and to all ports of every peer. What does not get through
/// is told nowhere: another way may.
void send_search(const StreamSocket& socket, std::string_view bytes,
                 const StreamNetwork& network) noexcept;
/// The next one that has come; none where none has.
struct ReceivedDatagram {
  std::string bytes;
  StreamAddress from;
};
[[nodiscard]] std::optional<ReceivedDatagram> receive_datagram(const StreamSocket& socket);

/// How many bytes went; none where the connection is gone.
[[nodiscard]] std::optional<std::size_t> send_bytes(const StreamSocket& socket,
                                                    std::string_view bytes) noexcept;
/// What has come; none where the connection is gone.
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
