#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/contact_sums.h"
#include "core/hand.h"
#include "core/haptic_state.h"
#include "core/random_stream.h"
#include "core/safety/fault.h"
#include "device/haptic_device.h"
#include "device/network/link_quality.h"
#include "device/stroking_arm.h"

/// What a device and the program send to each other across a network: datagrams of fixed sizes
/// in little-endian order. README.md beside this file describes them byte by byte. Received
/// bytes are never trusted: see `decode`.
namespace jnd::device::wire {

inline constexpr std::uint16_t kVersion = 3;
inline constexpr std::size_t kHeaderBytes = 40;
inline constexpr std::size_t kChecksumBytes = 4;
/// Size of the largest datagram, which is below what any Ethernet carries in one piece.
inline constexpr std::size_t kMaxBytes = 1280;
/// Longest time for which a measurement may be reused, whatever a device asks for. A larger
/// request is refused.
inline constexpr double kMostStale_s = 0.1;

/// The beginning of every datagram, besides magic, version, kind and size.
struct Header {
  /// Drawn by the device for each connection; 0 if there is none yet.
  std::uint64_t stream_id = 0;
  /// One more than the sender's last number on this stream, whatever the kind; it wraps. 0 in
  /// hellos, welcomes and refusals, which belong to no stream.
  std::uint32_t sequence = 0;
  std::int64_t sent_ns = 0;  ///< The sender's clock, with any epoch.
  /// `sent_ns` of the newest datagram that the sender had received; 0 for none.
  std::int64_t echo_ns = 0;
};

// The contents in the order of their kinds, from 1.

/// Program to device: wants to connect, or only to know the device's capabilities.
struct Hello {
  std::uint64_t token = 0;  ///< Drawn by the program; the answer repeats it.
  bool only_asks = false;
  /// The challenge of the last welcome, so that no old hello opens a stream.
  std::uint64_t challenge = 0;
  double rate_hz = 1000.0;  ///< Rate of the coming commands, > 0.
};

using DeviceText = std::array<char, 32>;  ///< Printable ASCII, filled up with zeros.

/// Device to program: its capabilities, and in the header the stream from now on.
struct Welcome {
  std::uint64_t token = 0;
  DeviceCapabilities capabilities;
  DeviceText name{};
  DeviceText serial{};          ///< Empty if unknown.
  DeviceText firmware{};        ///< Empty if unknown.
  std::uint64_t challenge = 0;  ///< The next hello that opens a stream has to repeat it.
};

enum class RefusalReason : std::uint8_t {
  kBusy = 1,           ///< Another program is connected.
  kUnknownStream = 2,  ///< The stream in the header does not exist, or no longer.
  kOtherVersion = 3,   ///< The header has the version of the device.
  kOtherKey = 4,       ///< The keys of the two sides differ, or only one side has one.
};

/// Device to program.
struct Refusal {
  std::uint64_t token = 0;  ///< Token of the hello; 0 if it was no hello.
  RefusalReason reason = RefusalReason::kBusy;
};

/// Device to program, in each of its ticks: the measurement, and what became of the force.
struct State {
  core::HapticState measured;
  core::ContactSums contact_sums;  ///< From a simulation; otherwise zeros.
  /// Strokes that the simulated hand has finished since its last order to stroke.
  std::int64_t strokes_finished = 0;
  /// Number of the last arming that was granted; 0 for none yet.
  std::uint32_t armed_number = 0;
  std::uint32_t order_number = 0;  ///< Number of the last order that was taken; 0 for none yet.
  bool armed = false;              ///< Forces are passed on.
  /// If false, the device could not be read: the measurement is old or zeros.
  bool is_measured = false;
  bool is_home = false;  ///< The simulated hand has come home since its last order.
  core::Fault fault = core::Fault::kNone;      ///< Why it was disarmed last.
  LinkLevel level = LinkLevel::kUnacceptable;  ///< Quality of the connection from the program.
};

/// Program to device, in each of its ticks.
struct Command {
  /// Number of the requested arming, from 1. A program raises it only after its own loop has
  /// latched a fault. The device grants it only to a command without any force.
  std::uint32_t arm_number = 0;
  std::uint32_t answered_sequence = 0;  ///< Number of the state to which the force responds.
  core::PointVectors force_on_hand_n = core::zero_vectors();
};

/// Program to a simulated device, until a state reports its number. It contains everything
/// ordered so far, so only the newest order has to arrive.
struct Order {
  std::uint32_t number = 0;  ///< From 1, increasing.
  /// Number of the order by which the hand moves; 0 for none yet.
  std::uint32_t movement_number = 0;
  std::uint32_t num_put_back = 0;  ///< How often fingers were to be put back.
  bool stroke = false;             ///< Whether it strokes; if not, it goes home.
  StrokePlan plan;
  core::RandomStream random{0, "stroke"};
};

/// Program to device: no force from now until it is armed again.
struct Halt {};

/// Either side: the connection is over.
struct Goodbye {};

using Content = std::variant<Hello, Welcome, Refusal, State, Command, Order, Halt, Goodbye>;

/// Works like `std::visit`, but never throws, because a content always is one of its kinds.
/// Real time.
template <std::size_t kIndex = 0, typename AnyContent, typename Visitor>
void visit_content(AnyContent& content, const Visitor& visitor) noexcept {
  if constexpr (kIndex < std::variant_size_v<Content>) {
    if (auto* const one = std::get_if<kIndex>(&content)) return visitor(*one);
    visit_content<kIndex + 1>(content, visitor);
  }
}

struct Datagram {
  Header header;
  Content content;
};

/// Why something is no valid datagram.
enum class Problem : std::uint8_t {
  kNone,
  kTooShort,
  kWrongMagic,
  kWrongVersion,
  kWrongSize,
  kWrongChecksum,
  kUnknownKind,
  kNotFinite,
  kOutOfRange,
  kOtherKey,  ///< See `DatagramSeal`.
};

/// Returns "wrong_checksum" and its like, as JSON spells them. Real time.
[[nodiscard]] std::string_view name(Problem problem) noexcept;

/// What is wrong with bytes that `decode` refuses, a part of a sentence with the kind, the
/// field and its offset: "a welcome whose share of the force at a point (offset 130) is out of
/// its range". "": nothing. Not real time.
[[nodiscard]] std::string problem_words(std::span<const std::byte> bytes);

/// Returns how many bytes were written. Real time.
[[nodiscard]] std::size_t encode(const Datagram& datagram,
                                 std::span<std::byte, kMaxBytes> bytes) noexcept;

/// Trusts nothing: what it accepts is finite, within its range, and encodes to exactly the same
/// bytes. If there is a problem, `datagram` is undefined. Real time.
[[nodiscard]] Problem decode(std::span<const std::byte> bytes, Datagram& datagram) noexcept;

/// Returns the version that bytes with our magic claim, or 0 without the magic. Real time.
[[nodiscard]] std::uint16_t version_of(std::span<const std::byte> bytes) noexcept;

/// Returns the size that bytes of our version claim, or 0 for others. Real time.
[[nodiscard]] std::size_t size_of(std::span<const std::byte> bytes) noexcept;

/// Whether its claimed kind is neither hello nor welcome nor refusal. Real time.
[[nodiscard]] bool is_of_stream(std::span<const std::byte> bytes) noexcept;

}  // namespace jnd::device::wire
