#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "device/haptic_device.h"
#include "device/network/datagram.h"
#include "device/network/datagram_port.h"
#include "device/network/datagram_seal.h"
#include "device/network/link_quality.h"
#include "device/network/remote_hand.h"

namespace jnd::device {

/// A device that another program serves, across a network: `DeviceServer`, or whatever speaks
/// the datagrams of README.md. It has a clock of its own, so the loop has to run in real time.
///
/// `read` takes in all that has come; the newest state wins and stands in for those that are
/// missing, for `max_stale_s` or as long as the device says. Beyond that, or where the device
/// is not armed, does not hear us, was restarted or the connection is too bad, `read` fails
/// with a fault, so that the loop latches; so does `write` when nothing can be sent. From then
/// on each tick works at coming back, without ever waiting: the same stream if it is there
/// still, else a new one; good quality for a while; and a new arming, which the device grants
/// to a command without force alone. Then `read` succeeds again, and force comes back when the
/// loop is armed, from zero.
///
/// One thread, as every device; `halt` any thread, `simulated_hand` one other.
class NetworkDevice final : public HapticDevice {
 public:
  struct Parameters {
    double rate_hz = 1000.0;           ///< Of the loop; the device's own is no lower.
    double max_stale_s = 0.020;        ///< > 0.
    double patience_s = 2.0;           ///< For the device to answer and the link to be good.
    std::uint64_t token = 1;           ///< Drawn anew for each run of the program.
    std::uint32_t first_sequence = 1;  ///< Of what it sends.
    /// With it, only a device that has it too is believed; see `DatagramSeal`.
    std::optional<DeviceKey> key;
    /// Whether a device that says of itself that nobody can be hurt by it is believed.
    bool believes_simulated = true;
  };

  /// Throws `core::Error` naming the field. Not real time.
  NetworkDevice(std::unique_ptr<DatagramPort> port, const Address& server,
                const Parameters& parameters);
  ~NetworkDevice() override;

  /// Asks the device what it can do, without connecting: from then on `capabilities` are its
  /// own, before they are those of no device in particular. Throws `DeviceUnreachable` if it
  /// does not answer or speaks another version. Not real time.
  void ask();

  [[nodiscard]] std::string_view name() const noexcept override { return "network"; }
  /// "lumped": what the device is called where it is served; "" before it answered. Real time.
  [[nodiscard]] std::string_view served_name() const noexcept;
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  [[nodiscard]] DeviceIdentity identity() const override;
  /// What it says itself, believed or not. Real time.
  [[nodiscard]] bool says_simulated() const noexcept {
    return device_ && device_->capabilities.simulated;
  }

  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override;
  [[nodiscard]] core::Fault fault() const noexcept override { return fault_; }
  /// The connection has been good for a while, both ways.
  [[nodiscard]] bool may_arm() const noexcept override;
  void halt() noexcept override;
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override;
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override {
    return newest_.contact_sums;
  }

  [[nodiscard]] std::optional<LinkReport> link() const noexcept override;

  /// Quality of the link, by the states that come in. Real time.
  [[nodiscard]] const LinkQuality& quality() const noexcept { return quality_; }

 private:
  enum class Phase {
    kClosed,
    kSeeking,  ///< No stream: says hello.
    kArming,   ///< A stream, but no trust in it yet: commands no force.
    kUp,
  };

  void take_in(std::int64_t now_ns) noexcept;
  void keep_refused(std::span<const std::byte> bytes) noexcept;
  void take(const wire::Header& header, const wire::Welcome& welcome,
            std::int64_t now_ns) noexcept;
  void take(const wire::Header& header, const wire::Refusal& refusal,
            std::int64_t now_ns) noexcept;
  void take(const wire::Header& header, const wire::State& state, std::int64_t now_ns) noexcept;
  void take(const wire::Header& header, const wire::Goodbye& goodbye,
            std::int64_t now_ns) noexcept;
  /// What only a device has to take.
  template <typename Content>
  void take(const wire::Header&, const Content&, std::int64_t) noexcept {}

  [[nodiscard]] std::int64_t max_stale_ns() const noexcept;
  [[nodiscard]] bool is_silent(std::int64_t now_ns) const noexcept;
  [[nodiscard]] bool is_deaf(std::int64_t now_ns) const noexcept;
  [[nodiscard]] bool is_armed() const noexcept;
  [[nodiscard]] bool has_disarmed() const noexcept;
  [[nodiscard]] bool is_trusted(std::int64_t now_ns) const noexcept;
  void judge(std::int64_t now_ns) noexcept;
  void lose(core::Fault fault, Phase phase) noexcept;
  void speak(const core::PointVectors& force_on_hand_n, std::int64_t now_ns) noexcept;
  void say_hello(bool only_asks, std::int64_t now_ns) noexcept;
  bool send(const wire::Content& content, std::int64_t now_ns) noexcept;
  void require_rate() const;
  [[nodiscard]] std::string what_is_wrong() const;

  std::unique_ptr<DatagramPort> port_;
  Address server_;
  Parameters parameters_;

  std::optional<wire::Welcome> device_;  ///< What the device said of itself at first.
  bool is_another_ = false;              ///< It introduced itself as something else since.
  std::optional<wire::RefusalReason> refusal_;
  std::uint16_t other_version_ = 0;
  bool has_other_key_ = false;
  int num_refused_ = 0;  ///< Datagrams while it was being opened that are none of the page's.
  std::array<std::byte, wire::kMaxBytes> refused_{};  ///< The last of them.
  std::size_t refused_size_ = 0;

  Phase phase_ = Phase::kClosed;
  core::Fault fault_ = core::Fault::kNone;
  std::uint64_t token_;
  std::uint64_t challenge_ = 0;
  DatagramSeal seal_;
  LinkQuality quality_;
  wire::State newest_;
  std::uint32_t newest_sequence_ = 0;
  std::int64_t newest_ns_ = 0;  ///< When it came.
  std::int64_t peer_sent_ns_ = 0;
  std::int64_t last_hello_ns_ = 0;
  std::int64_t first_read_ns_ = 0;  ///< 0: not read since it was opened.
  bool had_force_ = false;          ///< The loop has asked for one since it was opened.
  int num_failed_sends_ = 0;        ///< Commands in a row that the system did not take.
  std::uint32_t arm_number_ = 0;
  RemoteHand hand_;
  wire::Datagram incoming_;

  // Whoever halts needs these as well, from any thread.
  std::atomic<std::uint64_t> stream_id_{0};
  std::atomic<std::uint64_t> stream_token_{0};
  std::atomic<std::uint32_t> sequence_;
};

}  // namespace jnd::device
