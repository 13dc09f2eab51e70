#include <memory>
#include <optional>
#include <vector>

#include "chaos/hand_device.h"
#include "chaos/program_in_virtual_time.h"
#include "chaos/worlds.h"
#include "core/random_stream.h"
#include "device/network/device_server.h"
#include "device/network/network_device.h"
#include "device/network/simulated_network.h"

namespace jnd::chaos {
namespace {

using device::DeviceServer;
using device::NetworkDevice;
using device::SimulatedNetwork;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr int kTryAgainAfter_ms = 300;
constexpr std::size_t kMostRemembered = 500;

/// Plays a schedule with the program at one end of a network that behaves as the schedule says,
/// and the hand at the other end.
class NetworkWorld {
 public:
  explicit NetworkWorld(const Schedule& schedule)
      : schedule_(schedule),
        random_(schedule.seed, "datagrams"),
        oracle_(schedule),
        hand_(schedule, oracle_),
        program_(schedule, oracle_) {
    hand_.has_cable = false;
    network_.on_millisecond = [this] { pass_millisecond(); };
    network_.on_send = [this](const SimulatedNetwork::Sent& sent) { carry(sent); };
  }
  ~NetworkWorld() { stop_program(); }

  Outcome play() {
    while (now_ms_ < schedule_.lasts_ms && oracle_.violation().empty()) {
      network_.pass(kMillisecond_ns);
      stop_or_start_program();
      program_.tick_if_due(now_ms_);
    }
    oracle_.begin_millisecond(now_ms_ + 1);
    return {.violation = oracle_.violation(),
            .num_milliseconds_with_force = oracle_.num_milliseconds_with_force(),
            .most_given_j = oracle_.most_given_j()};
  }

 private:
  [[nodiscard]] bool is_on(Trouble what) const {
    return schedule_.on(what, now_ms_) != nullptr;
  }
  [[nodiscard]] bool happens(Trouble what) {
    const Event* event = schedule_.on(what, now_ms_);
    return event != nullptr && random_.with_probability(event->size);
  }

  /// Does everything of a millisecond except the loop's tick.
  void pass_millisecond() {
    oracle_.begin_millisecond(++now_ms_);
    program_.pass_millisecond(now_ms_);
    hand_.pass_millisecond(now_ms_);
    stop_or_start_server();
    if (server_ != nullptr && !is_on(Trouble::kServerStalls)) server_->step(network_.now_ns);
  }

  void stop_or_start_server() {
    if (is_on(Trouble::kServerRestarts)) return server_.reset();
    if (server_ != nullptr) return;
    server_port_ = network_.port(kServer);
    server_ = std::make_unique<DeviceServer>(
        hand_, *server_port_,
        DeviceServer::Parameters{.first_stream_id = random_.next_bits(), .key = key_});
    oracle_.server_restarted();
  }

  void stop_or_start_program() {
    if (is_on(Trouble::kProgramIsKilled)) return stop_program();
    if (program_.runs() || is_on(Trouble::kProgramStops) || now_ms_ < try_again_ms_) return;
    try {
      device_ = std::make_unique<NetworkDevice>(
          network_.port(device::address_number(++last_address_)), kServer,
          NetworkDevice::Parameters{.token = random_.next_bits(), .key = key_});
      device_->open();
      program_.start(*device_);
    } catch (const device::DeviceUnreachable&) {
      stop_program();
      try_again_ms_ = now_ms_ + kTryAgainAfter_ms;
    }
  }

  /// Stops the program without a goodbye, as if it were killed.
  void stop_program() {
    program_.kill();
    is_mute_ = true;
    device_.reset();
    is_mute_ = false;
  }

  void carry(SimulatedNetwork::Sent sent) {
    if (is_mute_ || is_on(Trouble::kUnplugged) || happens(Trouble::kLoses)) return;
    if (remembered_.size() < kMostRemembered) remembered_.push_back(sent);
    if (happens(Trouble::kCorrupts)) corrupt(sent.bytes);
    sent.arrives_ns += lateness_ns();
    network_.post(sent);
    if (happens(Trouble::kDoubles)) {
      sent.arrives_ns += lateness_ns();
      network_.post(sent);
    }
    if (happens(Trouble::kReplays)) replay();
  }

  std::int64_t lateness_ns() {
    std::int64_t late_ms = 0;
    if (const Event* delay = schedule_.on(Trouble::kDelays, now_ms_)) {
      late_ms += static_cast<std::int64_t>(delay->size);
    }
    if (const Event* reorder = schedule_.on(Trouble::kReorders, now_ms_)) {
      late_ms += static_cast<std::int64_t>(random_.uniform(0.0, reorder->size));
    }
    return kMillisecond_ns * late_ms;
  }

  void corrupt(device::Bytes& bytes) {
    const int num_bits = 1 + static_cast<int>(random_.below(20));
    for (int i = 0; i < num_bits; ++i) {
      bytes[random_.below(bytes.size())] ^= static_cast<std::byte>(1 << random_.below(8));
    }
    if (random_.with_probability(0.1)) bytes.resize(1 + random_.below(bytes.size()));
  }

  void replay() {
    SimulatedNetwork::Sent old = remembered_[random_.below(remembered_.size())];
    old.arrives_ns = network_.now_ns + lateness_ns();
    network_.post(old);
  }

  static inline const device::Address kServer = device::address_number(1);

  const Schedule& schedule_;
  core::RandomStream random_;
  /// Every other schedule has a key, by which both ends sign their datagrams.
  std::optional<device::DeviceKey> key_ =
      schedule_.seed % 2 == 0 ? std::nullopt : std::optional(device::DeviceKey{});
  SimulatedNetwork network_;
  Oracle oracle_;
  HandDevice hand_;
  std::unique_ptr<device::DatagramPort> server_port_;
  std::unique_ptr<DeviceServer> server_;
  std::unique_ptr<NetworkDevice> device_;
  ProgramInVirtualTime program_;
  std::vector<SimulatedNetwork::Sent> remembered_;
  std::uint32_t last_address_ = 1;
  int now_ms_ = 0;
  int try_again_ms_ = 0;
  bool is_mute_ = false;
};

}  // namespace

Outcome played_over_a_network(const Schedule& schedule) {
  return NetworkWorld(schedule).play();
}

}  // namespace jnd::chaos
