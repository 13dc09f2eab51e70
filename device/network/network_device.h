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

/// A device that another program serves across a network: `DeviceServer`, or any program that
/// follows README.md. It has a clock of its own, so the loop has to run in real time.
///
/// `read` takes in everything that has arrived. The newest state wins and is reused for missing
/// ones, for `max_stale_s` or as long as the device allows. `read` fails with a fault, which
/// the loop latches, after that time, or if the device is not armed, does not hear us or was
/// restarted, or if the connection is too bad. `write` fails if nothing can be sent. From then
/// on each tick works on recovering, without ever waiting: the same stream if it still exists,
/// or a new one; good quality for a while; and a new arming, which the device grants only to a
/// command without force. Then `read` succeeds again, and the force returns from zero when the
/// loop is armed.
///
/// One thread may use it, as with every device. Any thread may call `halt`, and one other
/// thread `simulated_hand`.
class NetworkDevice final : public HapticDevice {
 public:
  struct Parameters {
    /// Rate of the loop. The device's own rate is not lower.
    double rate_hz = 1000.0;
    double max_stale_s = 0.020;  ///< > 0.
    /// Time for the device to answer and the link to become good.
    double patience_s = 2.0;
    std::uint64_t token = 1;           ///< Drawn for each run of the program.
    std::uint32_t first_sequence = 1;  ///< Of what it sends.
    /// If set, only a device with the same key is trusted; see `DatagramSeal`.
    std::optional<DeviceKey> key;
    /// Whether to believe a device that says that nobody can be hurt by it.
    bool believes_simulated = true;
  };

  /// Throws `core::Error` naming the field. Not real time.
  NetworkDevice(std::unique_ptr<DatagramPort> port, const Address& server,
                const Parameters& parameters);
  ~NetworkDevice() override;

  /// Asks the device for its capabilities, without connecting. From then on `capabilities`
  /// returns them; before, they are those of no particular device. Throws `DeviceUnreachable`
  /// if it does not answer or speaks another version. Not real time.
  void ask();

  [[nodiscard]] std::string_view name() const noexcept override { return "network"; }
  /// Returns the device's name where it is served, such as "lumped", or "" before it answered.
  /// Real time.
  [[nodiscard]] std::string_view served_name() const noexcept;
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  [[nodiscard]] DeviceIdentity identity() const override;
  /// Returns what it says itself, whether that is believed or not. Real time.
  [[nodiscard]] bool says_simulated() const noexcept {
    return device_ && device_->capabilities.simulated;
  }

  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override;
  [[nodiscard]] core::Fault fault() const noexcept override { return fault_; }
  /// Whether the connection has been good for a while, in both directions.
  [[nodiscard]] bool may_arm() const noexcept override;
  void halt() noexcept override;
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override;
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override {
    return newest_.contact_sums;
  }

  [[nodiscard]] std::optional<LinkReport> link() const noexcept override;

  /// Returns the quality of the link, judged by the received states. Real time.
  [[nodiscard]] const LinkQuality& quality() const noexcept { return quality_; }

 private:
  enum class Phase {
    kClosed,
    kSeeking,  ///< There is no stream, so it says hello.
    kArming,   ///< There is a stream but no trust in it yet, so it commands no force.
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
  /// Contents that only a device takes are ignored.
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

  std::optional<wire::Welcome> device_;  ///< What the device said about itself at first.
  bool is_another_ = false;              ///< The device has since described itself differently.
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
  std::int64_t first_read_ns_ = 0;  ///< 0 if it was not read since it was opened.
  /// The loop has requested a force since the device was opened.
  bool had_force_ = false;
  int num_failed_sends_ = 0;  ///< Commands in a row that the system did not take.
  std::uint32_t arm_number_ = 0;
  RemoteHand hand_;
  wire::Datagram incoming_;

  // `halt` needs these as well, from any thread.
  std::atomic<std::uint64_t> stream_id_{0};
  std::atomic<std::uint64_t> stream_token_{0};
  std::atomic<std::uint32_t> sequence_;
};

}  // namespace jnd::device
