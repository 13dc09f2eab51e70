#include "device/network/udp_port.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>

#include "core/clock.h"
#include "core/error.h"
#include "device/haptic_device.h"

namespace jnd::device {
namespace {

using core::kNsPerS;

static_assert(sizeof(sockaddr_in6) <= sizeof(Address::bytes));
static_assert(sizeof(sockaddr_in) <= sizeof(Address::bytes));

/// An address in the form of the system's calls.
struct SystemAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_storage);

  [[nodiscard]] sockaddr* get() noexcept { return reinterpret_cast<sockaddr*>(&storage); }
};

SystemAddress system_address(const Address& address) noexcept {
  SystemAddress system;
  std::memcpy(&system.storage, address.bytes.data(), address.num_bytes);
  system.size = address.num_bytes;
  return system;
}

Address address_of(const SystemAddress& system) noexcept {
  Address address;
  address.num_bytes = std::min<std::uint32_t>(system.size, sizeof address.bytes);
  std::memcpy(address.bytes.data(), &system.storage, address.num_bytes);
  return address;
}

bool is_same_host(const Address& a, const Address& b) noexcept {
  const SystemAddress one = system_address(a);
  const SystemAddress other = system_address(b);
  if (one.storage.ss_family != other.storage.ss_family) return false;
  const auto is_same = [](const auto& x, const auto& y) {
    return std::memcmp(&x, &y, sizeof x) == 0;
  };
  if (one.storage.ss_family == AF_INET) {
    return is_same(reinterpret_cast<const sockaddr_in&>(one.storage).sin_addr,
                   reinterpret_cast<const sockaddr_in&>(other.storage).sin_addr);
  }
  return is_same(reinterpret_cast<const sockaddr_in6&>(one.storage).sin6_addr,
                 reinterpret_cast<const sockaddr_in6&>(other.storage).sin6_addr);
}

/// The port works as well on a system that grants none of this.
void ask_for_haste(int socket, bool is_6) noexcept {
  // The highest priority that every user may request.
  constexpr int kPriority = 6;
  constexpr int kExpeditedForwarding = 46 << 2;  // As it stands in the header's byte.
  const int one = 1;
  const auto ask = [socket](int level, int option, int value) {
    (void)::setsockopt(socket, level, option, &value, sizeof value);
  };
  ask(is_6 ? IPPROTO_IPV6 : IPPROTO_IP, is_6 ? IPV6_TCLASS : IP_TOS, kExpeditedForwarding);
  // This comes after the mark, which sets a priority of its own.
  ask(SOL_SOCKET, SO_PRIORITY, kPriority);
  ask(SOL_SOCKET, SO_TIMESTAMPNS, one);
}

std::int64_t time_ns(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

/// The kernel stamps by the clock of the day. Only how long ago that was counts, so a clock
/// that is set does no harm.
std::int64_t arrival_of(const msghdr& message) noexcept {
  constexpr std::int64_t kLongest_ns = kNsPerS;
  const std::int64_t now_ns = time_ns(CLOCK_MONOTONIC);
  for (const cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr;
       part = CMSG_NXTHDR(const_cast<msghdr*>(&message), const_cast<cmsghdr*>(part))) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    const std::int64_t ago_ns =
        time_ns(CLOCK_REALTIME) -
        (static_cast<std::int64_t>(stamp.tv_sec) * kNsPerS + stamp.tv_nsec);
    if (ago_ns >= 0 && ago_ns <= kLongest_ns) return now_ns - ago_ns;
  }
  return now_ns;
}

[[noreturn]] void refuse_endpoint(std::string_view text) {
  throw core::Error("network: expected HOST:PORT with a port from 1 to 65535, found " +
                    std::string(text.substr(0, 200)) +
                    "; write for example 127.0.0.1:4700 or [::1]:4700");
}

}  // namespace

Endpoint endpoint_of(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0) refuse_endpoint(text);
  std::string_view host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find_first_of(":[]") != std::string_view::npos) {
    refuse_endpoint(text);
  }
  const std::string_view digits = text.substr(colon + 1);
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc() || end != digits.data() + digits.size() || port == 0) {
    refuse_endpoint(text);
  }
  return {.host = std::string(host), .port = port};
}

Address resolved(const Endpoint& endpoint) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(endpoint.host.c_str(), std::to_string(endpoint.port).c_str(),
                                  &wanted, &found);
  if (error != 0) {
    throw core::Error("network: expected a host that this machine can find, found " +
                      endpoint.host + " (" + ::gai_strerror(error) +
                      "); check its spelling and the network");
  }
  const addrinfo* chosen = found;
  while (chosen != nullptr && chosen->ai_family != AF_INET) chosen = chosen->ai_next;
  if (chosen == nullptr) chosen = found;
  SystemAddress system;
  system.size = chosen->ai_addrlen;
  std::memcpy(&system.storage, chosen->ai_addr, chosen->ai_addrlen);
  ::freeaddrinfo(found);
  return address_of(system);
}

bool is_loopback(const Address& address) noexcept {
  const SystemAddress system = system_address(address);
  if (system.storage.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(system.storage);
    constexpr std::uint32_t kLoopbackNet = 127;
    return ntohl(v4.sin_addr.s_addr) >> 24 == kLoopbackNet;
  }
  const auto& v6 = reinterpret_cast<const sockaddr_in6&>(system.storage);
  return system.storage.ss_family == AF_INET6 && IN6_IS_ADDR_LOOPBACK(&v6.sin6_addr);
}

std::string text_of(const Address& address) {
  SystemAddress system = system_address(address);
  char host[NI_MAXHOST] = "";
  char port[NI_MAXSERV] = "";
  if (::getnameinfo(system.get(), system.size, host, sizeof host, port, sizeof port,
                    NI_NUMERICHOST | NI_NUMERICSERV | NI_DGRAM) != 0) {
    return "nowhere";
  }
  const bool is_6 = system.storage.ss_family == AF_INET6;
  return (is_6 ? "[" + std::string(host) + "]" : host) + ":" + port;
}

UdpPort::UdpPort(const Address& local) {
  SystemAddress system = system_address(local);
  socket_ = ::socket(system.storage.ss_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ >= 0) ask_for_haste(socket_, system.storage.ss_family == AF_INET6);
  if (socket_ >= 0 && ::bind(socket_, system.get(), system.size) == 0) return;
  const std::string why = std::strerror(errno);
  if (socket_ >= 0) ::close(socket_);
  throw core::Error("network: expected " + text_of(local) + " to be free, found: " + why +
                    "; choose another port or address");
}

std::unique_ptr<UdpPort> UdpPort::connected_to(const Address& peer) {
  SystemAddress any;
  SystemAddress system = system_address(peer);
  any.storage.ss_family = system.storage.ss_family;
  any.size = peer.num_bytes;
  auto port = std::make_unique<UdpPort>(address_of(any));
  if (::connect(port->socket_, system.get(), system.size) == 0) return port;
  throw DeviceUnreachable("network: expected a way to " + text_of(peer) +
                          ", found: " + std::strerror(errno) + "; check address and network");
}

UdpPort::~UdpPort() { ::close(socket_); }

Address UdpPort::local() const {
  SystemAddress system;
  if (::getsockname(socket_, system.get(), &system.size) != 0) {
    throw core::Error("network: expected a socket to have an address, found: " +
                      std::string(std::strerror(errno)));
  }
  return address_of(system);
}

bool UdpPort::send(std::span<const std::byte> datagram, const Address& to) noexcept {
  SystemAddress system = system_address(to);
  // The next call on a connected socket reports errors of the datagram before, such as that
  // nobody received it or that there is no route. They do not concern this datagram.
  for (int attempt = 0; attempt < 2; ++attempt) {
    const ssize_t sent = ::sendto(socket_, datagram.data(), datagram.size(),
                                  MSG_DONTWAIT | MSG_NOSIGNAL, system.get(), system.size);
    if (sent >= 0) return sent == static_cast<ssize_t>(datagram.size());
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS) return false;
  }
  return false;
}

std::size_t UdpPort::receive(std::span<std::byte> bytes, Address& from) noexcept {
  SystemAddress system;
  // An empty datagram is useless, but it must not hide those behind it. Nor must somebody's
  // message that one of our datagrams did not arrive.
  for (int attempt = 0; attempt < 16; ++attempt) {
    iovec where{.iov_base = bytes.data(), .iov_len = bytes.size()};
    alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sizeof(timespec))> stamps{};
    msghdr message{};
    message.msg_name = system.get();
    message.msg_namelen = system.size;
    message.msg_iov = &where;
    message.msg_iovlen = 1;
    message.msg_control = stamps.data();
    message.msg_controllen = stamps.size();
    const ssize_t size = ::recvmsg(socket_, &message, MSG_DONTWAIT);
    if (size > 0) {
      system.size = message.msg_namelen;
      arrived_ns_ = arrival_of(message);
      from = address_of(system);
      const bool is_accepted =
          hosts_.empty() || std::any_of(hosts_.begin(), hosts_.end(), [&](const Address& host) {
            return is_same_host(host, from);
          });
      if (!is_accepted) {
        ++num_not_accepted_;
        system.size = sizeof system.storage;
        continue;
      }
      return static_cast<std::size_t>(size);
    }
    if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return 0;
    system.size = sizeof system.storage;
  }
  return 0;
}

std::int64_t UdpPort::now_ns() const noexcept { return time_ns(CLOCK_MONOTONIC); }

void UdpPort::pause(std::int64_t duration_ns) noexcept {
  const timespec duration{.tv_sec = static_cast<time_t>(duration_ns / kNsPerS),
                          .tv_nsec = static_cast<long>(duration_ns % kNsPerS)};
  clock_nanosleep(CLOCK_MONOTONIC, 0, &duration, nullptr);
}

}  // namespace jnd::device
