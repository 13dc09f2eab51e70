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

/// A program at the other end of a connection that trusts nothing. It keeps every state as it
/// came, whatever its number, and can repeat what it has sent. It is for testing a device; a
/// session uses `NetworkDevice`. Not real time.
class LinkProbe {
 public:
  struct Seen {
    wire::Header header;
    wire::State state;
    std::int64_t came_ns = 0;  ///< Time by our clock.
  };

  /// The port must outlive this object. `token` distinguishes the program from others.
  LinkProbe(DatagramPort& port, const Address& server, const std::optional<DeviceKey>& key,
            std::uint64_t token);

  /// Becomes another program, with this token, that has not connected.
  void begin_anew(std::uint64_t token);
  /// Limits all commanded forces by this limiter, with the velocities of the newest state.
  void limit_by(const core::ForceLimiter& limiter) { limiter_ = limiter; }

  /// Says hello until a stream is opened. Returns false if that takes longer than this time;
  /// see `refusal`.
  [[nodiscard]] bool connect(double timeout_s);
  /// Says hello once and takes in what has come.
  void say_hello();

  [[nodiscard]] bool is_connected() const noexcept { return stream_id_ != 0; }
  [[nodiscard]] const wire::Welcome& welcome() const noexcept { return *welcome_; }
  [[nodiscard]] std::optional<wire::RefusalReason> refusal() const noexcept { return refusal_; }

  /// Sends commands at the device's rate for this time, each followed by `also`. Returns the
  /// states that came meanwhile.
  const std::vector<Seen>& talk(double duration_s, std::uint32_t arm_number,
                                const core::PointVectors& force_on_hand_n,
                                const std::function<void()>& also = {});
  /// Sends nothing. Returns the states that came meanwhile.
  const std::vector<Seen>& listen(double duration_s);
  /// Asks for arming by commands without force for a second. Returns whether it was granted.
  [[nodiscard]] bool arm(std::uint32_t arm_number);
  void halt();
  void say_goodbye();

  /// Returns the bytes of the last command. `send_again` sends bytes as they are.
  [[nodiscard]] const std::vector<std::byte>& last_command() const noexcept { return last_; }
  void send_again(const std::vector<std::byte>& bytes);

  /// Whether the program has sent a datagram with this clock.
  [[nodiscard]] bool has_sent_at(std::int64_t clock_ns) const {
    return sent_ns_.contains(clock_ns);
  }
  /// Number of foreign datagrams, and the problem of the last one.
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
  core::HapticState measured_;     ///< Measurement in the newest state.
  std::int64_t peer_sent_ns_ = 0;  ///< Time by the device's clock.
  std::optional<core::ForceLimiter> limiter_;
  std::vector<Seen> seen_;
  std::vector<std::byte> last_;
  std::set<std::int64_t> sent_ns_{0};
  int num_refused_ = 0;
  wire::Problem last_problem_ = wire::Problem::kNone;
  std::vector<std::byte> refused_;  ///< The last one.
};

}  // namespace jnd::device
