#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/hand.h"
#include "core/safety/force_limiter.h"
#include "device/network/datagram.h"
#include "device/network/datagram_port.h"
#include "device/network/datagram_seal.h"

namespace jnd::device {

/// A program at the other end of a connection that believes nothing: it keeps every state as it
/// came, whatever its number, and can say again what it has said. To try a device with; a
/// session uses `NetworkDevice`. Not real time.
class LinkProbe {
 public:
  struct Seen {
    wire::Header header;
    wire::State state;
    std::int64_t came_ns = 0;  ///< Our clock.
  };

  /// Port has to outlive this. `token` tells it from other programs.
  LinkProbe(DatagramPort& port, const Address& server, const std::optional<DeviceKey>& key,
            std::uint64_t token);

  /// From now on it is another program, with this token, that has not connected.
  void begin_anew(std::uint64_t token);
  /// What it commands goes through this, by the velocities of the newest state.
  void limit_by(const core::ForceLimiter& limiter) { limiter_ = limiter; }

  /// Says hello until a stream is opened. False: not within this time; see `refusal`.
  [[nodiscard]] bool connect(double timeout_s);
  /// Says hello once, and takes in what has come.
  void say_hello();

  [[nodiscard]] bool is_connected() const noexcept { return stream_id_ != 0; }
  [[nodiscard]] const wire::Welcome& welcome() const noexcept { return *welcome_; }
  [[nodiscard]] std::optional<wire::RefusalReason> refusal() const noexcept { return refusal_; }

  /// Commands at the device's rate for so long, each followed by `also`. The states that came
  /// meanwhile.
  const std::vector<Seen>& talk(double duration_s, std::uint32_t arm_number,
                                const core::PointVectors& force_on_hand_n,
                                const std::function<void()>& also = {});
  /// Says nothing. The states that came meanwhile.
  const std::vector<Seen>& listen(double duration_s);
  /// Asks for an arming by commands without force for a second. Whether it was granted.
  [[nodiscard]] bool arm(std::uint32_t arm_number);
  void halt();
  void say_goodbye();

  /// The bytes of the last command, and to send bytes as they are.
  [[nodiscard]] const std::vector<std::byte>& last_command() const noexcept { return last_; }
  void send_again(const std::vector<std::byte>& bytes);

  /// Whether the program has sent a datagram with this clock.
  [[nodiscard]] bool has_sent_at(std::int64_t clock_ns) const {
    return sent_ns_.contains(clock_ns);
  }
  /// Datagrams that were none of ours, and the last one's problem.
  [[nodiscard]] int num_refused() const noexcept { return num_refused_; }
  [[nodiscard]] wire::Problem last_problem() const noexcept { return last_problem_; }
  /// What was wrong with the last one, see `wire::problem_words`.
  [[nodiscard]] std::string last_problem_words() const {
    return last_problem_ == wire::Problem::kOtherKey ? "one with another seal"
                                                     : wire::problem_words(refused_);
  }

 private:
  void receive();
  void take(const wire::Datagram& datagram, std::int64_t now_ns);
  std::vector<std::byte> send(const wire::Content& content);

  DatagramPort& port_;
  Address server_;
  DatagramSeal seal_;
  std::uint64_t token_;
  std::uint64_t challenge_ = 0;
  std::uint64_t stream_id_ = 0;
  std::optional<wire::Welcome> welcome_;
  std::optional<wire::RefusalReason> refusal_;
  std::uint32_t sequence_ = 1;
  std::uint32_t newest_ = 0;       ///< Number of the newest state.
  core::HapticState measured_;     ///< In it.
  std::int64_t peer_sent_ns_ = 0;  ///< Its clock.
  std::optional<core::ForceLimiter> limiter_;
  std::vector<Seen> seen_;
  std::vector<std::byte> last_;
  std::set<std::int64_t> sent_ns_{0};
  int num_refused_ = 0;
  wire::Problem last_problem_ = wire::Problem::kNone;
  std::vector<std::byte> refused_;  ///< The last one.
};

}  // namespace jnd::device
