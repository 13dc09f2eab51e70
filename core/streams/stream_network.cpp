#include "core/streams/stream_network.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <ctime>
#include <utility>

#include "core/error.h"

namespace jnd::core {
namespace {

constexpr std::size_t kLargestDatagram = 65536;
constexpr int kWaitingConnections = 16;

sockaddr_in system_address_of(const StreamAddress& address) noexcept {
  sockaddr_in system{};
  system.sin_family = AF_INET;
  system.sin_addr.s_addr = htonl(address.host);
  system.sin_port = htons(address.port);
  return system;
}

[[noreturn]] void refuse_socket(const std::string& expected) {
  throw Error("streams: expected " + expected + ", found: " + std::strerror(errno) +
              "; look whether the network is up and other programs hold its ports");
}

StreamSocket new_socket(int type) {
  StreamSocket socket(::socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.is_open()) refuse_socket("a socket");
  return socket;
}

void set_option(const StreamSocket& socket, int level, int option, int value) noexcept {
  (void)::setsockopt(socket.descriptor(), level, option, &value, sizeof value);
}

bool bind_to(const StreamSocket& socket, std::uint16_t port) noexcept {
  const sockaddr_in system = system_address_of({.host = INADDR_ANY, .port = port});
  return ::bind(socket.descriptor(), reinterpret_cast<const sockaddr*>(&system),
                sizeof system) == 0;
}

void bind_in_range(const StreamSocket& socket, const StreamNetwork& network) {
  for (int i = 0; i < network.num_ports; ++i) {
    const int port = network.first_port + i;
    if (port <= USHRT_MAX && bind_to(socket, static_cast<std::uint16_t>(port))) return;
  }
  if (!bind_to(socket, 0)) refuse_socket("a free port");
}

bool is_multicast(std::uint32_t host) noexcept { return host >> 28 == 0xE; }

}  // namespace

double stream_clock_s() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string host_text(const StreamAddress& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const in_addr host{.s_addr = htonl(address.host)};
  ::inet_ntop(AF_INET, &host, text.data(), text.size());
  return text.data();
}

std::optional<StreamAddress> numeric_address(const std::string& host, std::uint16_t port) {
  in_addr numeric{};
  if (::inet_pton(AF_INET, host.c_str(), &numeric) != 1) return std::nullopt;
  return StreamAddress{.host = ntohl(numeric.s_addr), .port = port};
}

std::optional<StreamAddress> named_address(const std::string& host, std::uint16_t port) {
  if (const auto numeric = numeric_address(host, port)) return numeric;
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0) return std::nullopt;
  sockaddr_in system{};
  std::memcpy(&system, found->ai_addr, sizeof system);
  ::freeaddrinfo(found);
  return StreamAddress{.host = ntohl(system.sin_addr.s_addr), .port = port};
}

std::vector<StreamAddress> own_addresses() {
  std::vector<StreamAddress> addresses;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return addresses;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    const bool is_up = (one->ifa_flags & IFF_UP) != 0;
    if (!is_up || one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in system{};
    std::memcpy(&system, one->ifa_addr, sizeof system);
    addresses.push_back({.host = ntohl(system.sin_addr.s_addr)});
  }
  ::freeifaddrs(all);
  return addresses;
}

std::string own_hostname() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

StreamSocket::StreamSocket(StreamSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

StreamSocket& StreamSocket::operator=(StreamSocket&& other) noexcept {
  if (this != &other) {
    close();
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

StreamSocket::~StreamSocket() { close(); }

void StreamSocket::close() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

std::uint16_t StreamSocket::port() const noexcept {
  sockaddr_in system{};
  socklen_t size = sizeof system;
  if (::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&system), &size) != 0) return 0;
  return ntohs(system.sin_port);
}

StreamSocket datagram_socket() {
  StreamSocket socket = new_socket(SOCK_DGRAM);
  if (!bind_to(socket, 0)) refuse_socket("a free port");
  return socket;
}

StreamSocket service_socket(const StreamNetwork& network) {
  StreamSocket socket = new_socket(SOCK_DGRAM);
  bind_in_range(socket, network);
  return socket;
}

StreamSocket search_socket(const StreamNetwork& network) {
  StreamSocket socket = new_socket(SOCK_DGRAM);
  set_option(socket, SOL_SOCKET, SO_REUSEADDR, 1);
  if (!bind_to(socket, network.search_port)) {
    refuse_socket("to share port " + std::to_string(network.search_port));
  }
  for (const std::string& group : network.groups) {
    const auto address = numeric_address(group, 0);
    if (!address || !is_multicast(address->host)) continue;
    for (const StreamAddress& own : own_addresses()) {
      ip_mreq membership{};
      membership.imr_multiaddr.s_addr = htonl(address->host);
      membership.imr_interface.s_addr = htonl(own.host);
      // An interface without multicast groups still receives broadcasts.
      (void)::setsockopt(socket.descriptor(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership,
                         sizeof membership);
    }
  }
  return socket;
}

StreamSocket listening_socket(const StreamNetwork& network) {
  // Two sockets may bind one port as long as neither listens. The first to listen has it.
  for (int i = 0; i <= network.num_ports; ++i) {
    StreamSocket socket = new_socket(SOCK_STREAM);
    const int port = i < network.num_ports ? network.first_port + i : 0;
    if (port > USHRT_MAX) continue;
    if (bind_to(socket, static_cast<std::uint16_t>(port)) &&
        ::listen(socket.descriptor(), kWaitingConnections) == 0) {
      return socket;
    }
  }
  refuse_socket("a free port for connections");
}

StreamSocket connecting_socket(const StreamAddress& to) {
  StreamSocket socket = new_socket(SOCK_STREAM);
  set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  const sockaddr_in system = system_address_of(to);
  if (::connect(socket.descriptor(), reinterpret_cast<const sockaddr*>(&system),
                sizeof system) != 0 &&
      errno != EINPROGRESS) {
    refuse_socket("a way to " + host_text(to) + ":" + std::to_string(to.port));
  }
  return socket;
}

bool is_connected(const StreamSocket& socket) noexcept {
  int error = 0;
  socklen_t size = sizeof error;
  return ::getsockopt(socket.descriptor(), SOL_SOCKET, SO_ERROR, &error, &size) == 0 &&
         error == 0;
}

StreamSocket accepted_socket(const StreamSocket& listener) noexcept {
  StreamSocket socket(
      ::accept4(listener.descriptor(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (socket.is_open()) set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  return socket;
}

bool send_datagram(const StreamSocket& socket, std::string_view bytes,
                   const StreamAddress& to) noexcept {
  const sockaddr_in system = system_address_of(to);
  return ::sendto(socket.descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&system),
                  sizeof system) == static_cast<ssize_t>(bytes.size());
}

void send_search(const StreamSocket& socket, std::string_view bytes,
                 const StreamNetwork& network) noexcept {
  set_option(socket, SOL_SOCKET, SO_BROADCAST, 1);
  set_option(socket, IPPROTO_IP, IP_MULTICAST_TTL, network.num_hops);
  const std::vector<StreamAddress> own = own_addresses();
  for (const std::string& group : network.groups) {
    const auto address = numeric_address(group, network.search_port);
    if (!address) continue;
    if (!is_multicast(address->host)) {
      (void)send_datagram(socket, bytes, *address);
      continue;
    }
    for (const StreamAddress& one : own) {
      const in_addr interface { .s_addr = htonl(one.host) };
      (void)::setsockopt(socket.descriptor(), IPPROTO_IP, IP_MULTICAST_IF, &interface,
                         sizeof interface);
      (void)send_datagram(socket, bytes, *address);
    }
  }
  for (const std::string& peer : network.peers) {
    auto address = named_address(peer, network.first_port);
    for (int i = 0; address && i < network.num_ports; ++i, ++address->port) {
      (void)send_datagram(socket, bytes, *address);
    }
  }
}

std::optional<ReceivedDatagram> receive_datagram(const StreamSocket& socket) {
  thread_local std::string buffer(kLargestDatagram, '\0');
  sockaddr_in system{};
  socklen_t size = sizeof system;
  while (true) {
    const ssize_t count = ::recvfrom(socket.descriptor(), buffer.data(), buffer.size(),
                                     MSG_DONTWAIT, reinterpret_cast<sockaddr*>(&system), &size);
    if (count >= 0) {
      return ReceivedDatagram{
          .bytes = buffer.substr(0, static_cast<std::size_t>(count)),
          .from = {.host = ntohl(system.sin_addr.s_addr), .port = ntohs(system.sin_port)}};
    }
    // This error is about an earlier datagram of ours that reached nobody. It does not concern
    // what has arrived.
    if (errno != ECONNREFUSED && errno != EINTR) return std::nullopt;
  }
}

std::optional<std::size_t> send_bytes(const StreamSocket& socket,
                                      std::string_view bytes) noexcept {
  const ssize_t count =
      ::send(socket.descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return 0;
  return std::nullopt;
}

std::optional<std::string> receive_bytes(const StreamSocket& socket) {
  thread_local std::string buffer(kLargestDatagram, '\0');
  const ssize_t count = ::recv(socket.descriptor(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count > 0) return buffer.substr(0, static_cast<std::size_t>(count));
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return "";
  return std::nullopt;
}

StreamWake::StreamWake() : socket_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!socket_.is_open()) refuse_socket("a way to wake a thread");
}

void StreamWake::wake() const noexcept {
  const std::uint64_t one = 1;
  (void)!::write(socket_.descriptor(), &one, sizeof one);
}

void StreamWake::clear() const noexcept {
  std::uint64_t count = 0;
  (void)!::read(socket_.descriptor(), &count, sizeof count);
}

}  // namespace jnd::core
