#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/safety/force_limiter.h"
#include "device/haptic_device.h"
#include "device/network/datagram.h"
#include "device/network/datagram_port.h"
#include "device/network/datagram_seal.h"
#include "device/network/link_quality.h"

namespace jnd::device {

/// Serves a device to one program at a time, across a network. It trusts nothing that it
/// receives. It passes a force on only while
/// - it was requested on this stream, by the address that opened it;
/// - the connection had been good for a while when the device was armed;
/// - a command newer than all before has come within `watchdog_s`;
/// - that command responds to a state younger than `max_answer_age_s`;
/// - the steps themselves came without a pause of `watchdog_s`;
/// - the device was read in this step, and its enabling switch is closed.
///
/// It also limits forces by itself, as `core::ForceLimiter` does. If any condition fails, the
/// force ends at once, until the program arms again by a command with a new number and without
/// any force. So neither a program that died nor one that came back can make a force step.
///
/// It uses no wall clock: a thread or a test passes the time to `step`.
class DeviceServer {
 public:
  struct Parameters {
    /// > 0. A state may be late for as long, see `Welcome`.
    double watchdog_s = 0.020;
    /// > 0; covers a reused state and the way there and back.
    double max_answer_age_s = 0.040;
    /// Silence after which another program may connect, > 0.
    double client_timeout_s = 1.0;
    double slew_n_per_s = 2000.0;       ///< > 0.
    std::uint64_t first_stream_id = 1;  ///< Drawn whenever a server starts.
    std::uint32_t first_sequence = 1;   ///< Of what it sends on a stream.
    std::uint64_t first_challenge = 0;  ///< Drawn whenever a server starts.
    /// If set, only programs with the same key are heard; see `DatagramSeal`.
    std::optional<DeviceKey> key;
  };

  /// Counts for a person to read at the end.
  struct Counts {
    std::int64_t num_steps = 0;
    std::int64_t num_clients = 0;
    std::int64_t num_turned_away = 0;  ///< Hellos while another program was connected.
    std::int64_t num_armings = 0;
    std::int64_t num_disarmings = 0;  ///< Except those that the program requested.
    core::Fault last_fault = core::Fault::kNone;
  };

  /// Device and port must outlive this object. Throws `core::Error` naming the field. Not real
  /// time.
  DeviceServer(HapticDevice& device, DatagramPort& port, const Parameters& parameters);
  DeviceServer(const DeviceServer&) = delete;
  DeviceServer& operator=(const DeviceServer&) = delete;

  /// Runs one of the device's ticks: takes in what has arrived, reads the device, writes its
  /// force and sends a state to the program. The caller opens and closes the device. Real time.
  void step(std::int64_t now_ns) noexcept;
  /// The machine slept before the next step, while the clock of `step` stood still: whatever
  /// waits for it is as old as that. Real time.
  void suspended() noexcept;
  /// Between steps: opens the device anew if a program has left it since, so that the next one
  /// finds a simulation as it was at the start. Throws what `open` throws. Not real time.
  void renew_device();
  /// Says goodbye to the program and ends the force. Real time.
  void dismiss(std::int64_t now_ns) noexcept;

  [[nodiscard]] bool has_client() const noexcept { return client_.has_value(); }
  [[nodiscard]] bool is_armed() const noexcept { return armed_; }
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  /// Returns the quality of the received commands, of all programs together.
  [[nodiscard]] const LinkQuality& quality() const noexcept { return quality_; }

 private:
  struct Client {
    Address address;
    std::uint64_t token = 0;
    std::uint64_t stream_id = 0;
    std::int64_t last_heard_ns = 0;
    std::int64_t last_sent_ns = 0;  ///< The client's own clock in its newest datagram.
    bool commanded = false;         ///< A command has come.
    /// A command has come, and since then the server has made no pause.
    bool is_recent = false;
    std::uint32_t command_sequence = 0;
    std::int64_t command_ns = 0;  ///< When the newest command came.
    wire::Command command;
    std::uint32_t movement_number = 0,
                  num_put_back = 0;  ///< Numbers of the last order that was taken.
  };

  void take_in(std::int64_t now_ns) noexcept;
  void refuse(const Address& to, std::uint64_t stream_id, const wire::Refusal& refusal,
              std::int64_t now_ns) noexcept;
  void hint(const Address& to, wire::RefusalReason reason, std::int64_t now_ns) noexcept;
  void take(const wire::Hello& hello, const Address& from, std::int64_t now_ns) noexcept;
  void take_from_client(const wire::Header& header, const wire::Content& content,
                        std::int64_t now_ns) noexcept;
  void take(const wire::Header& header, const wire::Command& command,
            std::int64_t now_ns) noexcept;
  void take(const wire::Order& order) noexcept;
  [[nodiscard]] std::size_t place_of(std::uint32_t sequence) const noexcept {
    return sequence & (sent_ns_.size() - 1);
  }
  [[nodiscard]] bool answers_in_time(std::int64_t now_ns) const noexcept;
  void arm_or_disarm(std::int64_t now_ns) noexcept;
  void disarm(core::Fault fault) noexcept;
  void watch(std::int64_t now_ns) noexcept;
  void watch_own_pace(std::int64_t now_ns) noexcept;
  void measure() noexcept;
  void apply_force() noexcept;
  void tell_client(std::int64_t now_ns) noexcept;
  void end_session() noexcept;
  void part_with_client() noexcept;
  void send(const Address& to, std::uint64_t stream_id, const wire::Content& content,
            std::int64_t now_ns) noexcept;

  HapticDevice& device_;
  DatagramPort& port_;
  Parameters parameters_;
  std::int64_t watchdog_ns_, client_timeout_ns_;
  std::int64_t max_answer_age_ns_;
  std::uint32_t max_answer_age_;        ///< In steps: more of them take longer, or come early.
  std::int64_t steps_per_command_ = 1;  ///< By the rates of both sides.
  wire::Welcome welcome_;
  core::ForceLimiter limiter_;
  /// When each state was sent that may still be answered, by its number: a step that came late
  /// makes the answers older.
  std::vector<std::int64_t> sent_ns_;
  bool tells_acting_force_;
  core::PointVectors written_n_ = core::zero_vectors();  ///< The force that was written last.
  LinkQuality quality_;
  Counts counts_;

  DatagramSeal seal_;
  std::optional<Client> client_;
  std::uint64_t next_stream_id_;
  std::uint32_t sequence_;
  bool armed_ = false;
  bool was_enabled_ = false;   ///< Whether the device was enabled in the step before.
  int num_failed_writes_ = 0;  ///< In a row.
  bool was_used_ = false;      ///< A program has left the device since it was opened.
  std::optional<std::int64_t> last_step_ns_;
  // The number of answers in a step is limited, so that nobody can be flooded through this
  // server.
  int num_welcomed_in_step_ = 0;
  bool refused_in_step_ = false;
  wire::State state_;
  wire::Datagram incoming_;
};

}  // namespace jnd::device
