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

/// What a device and the program say to each other across a network: datagrams of fixed sizes,
/// little endian, described byte by byte in README.md beside this file. What comes in is never
/// trusted: see `decode`.
namespace jnd::device::wire {

inline constexpr std::uint16_t kVersion = 3;
inline constexpr std::size_t kHeaderBytes = 40;
inline constexpr std::size_t kChecksumBytes = 4;
/// Of the largest datagram; below what any Ethernet carries in one piece.
inline constexpr std::size_t kMaxBytes = 1280;
/// However long a device says that its measurements may stand in: more is refused.
inline constexpr double kMostStale_s = 0.1;

/// What every datagram begins with, besides magic, version, kind and size.
struct Header {
  /// Drawn by the device for each connection; 0 where there is none yet.
  std::uint64_t stream_id = 0;
  /// One more than the sender's last on this stream, whatever its kind; wraps. 0 in hellos,
  /// welcomes and refusals, which belong to none.
  std::uint32_t sequence = 0;
  std::int64_t sent_ns = 0;  ///< The sender's clock, any epoch.
  std::int64_t echo_ns = 0;  ///< `sent_ns` of the newest that it had received; 0: none.
};

// The contents, in the order of their kinds, from 1 on.

/// Program to device: wants to connect, or only to know what the device can do.
struct Hello {
  std::uint64_t token = 0;  ///< Drawn by the program; the answer repeats it.
  bool only_asks = false;
  std::uint64_t challenge = 0;  ///< Of the last welcome: no old hello opens a stream.
  double rate_hz = 1000.0;      ///< Of the commands that will come, > 0.
};

using DeviceText = std::array<char, 32>;  ///< Printable ASCII, zeros behind it.

/// Device to program: what it can do, and the stream from now on, in the header.
struct Welcome {
  std::uint64_t token = 0;
  DeviceCapabilities capabilities;
  DeviceText name{};
  DeviceText serial{};          ///< Empty: it does not say.
  DeviceText firmware{};        ///< Likewise.
  std::uint64_t challenge = 0;  ///< What the next hello that opens a stream has to repeat.
};

enum class RefusalReason : std::uint8_t {
  kBusy = 1,           ///< Another program is connected.
  kUnknownStream = 2,  ///< The stream in the header is none, or none any more.
  kOtherVersion = 3,   ///< The header says which one the device speaks.
  kOtherKey = 4,       ///< The keys of both sides differ, or only one has one.
};

/// Device to program.
struct Refusal {
  std::uint64_t token = 0;  ///< Of the hello; 0 if it was none.
  RefusalReason reason = RefusalReason::kBusy;
};

/// Device to program, each of its ticks: what was measured, and what became of the force.
struct State {
  core::HapticState measured;
  core::ContactSums contact_sums;  ///< Of a simulation, else zeros.
  std::int64_t strokes_finished =
      0;                           ///< Of the simulated hand, since its last order to stroke.
  std::uint32_t armed_number = 0;  ///< Of the last arming that was granted; 0: none yet.
  std::uint32_t order_number = 0;  ///< Of the last order that was taken; 0: none yet.
  bool armed = false;              ///< Forces are passed on.
  bool is_measured = false;        ///< Else the device could not be read: old or zeros.
  bool is_home = false;            ///< The simulated hand, since its last order.
  core::Fault fault = core::Fault::kNone;      ///< Why it was disarmed last.
  LinkLevel level = LinkLevel::kUnacceptable;  ///< Of what comes from the program.
};

/// Program to device, each of its ticks.
struct Command {
  /// Of the arming asked for, from 1 on. A program raises it only after its own loop has
  /// latched a fault; the device grants it only to a command without any force.
  std::uint32_t arm_number = 0;
  std::uint32_t answered_sequence = 0;  ///< Of the state that the force answers to.
  core::PointVectors force_on_hand_n = core::zero_vectors();
};

/// Program to a simulated device, until a state has taken its number: all that was ordered so
/// far, so that only the newest has to arrive.
struct Order {
  std::uint32_t number = 0;           ///< From 1 on, rising.
  std::uint32_t movement_number = 0;  ///< Of the order that it moves by; 0: none yet.
  std::uint32_t num_put_back = 0;     ///< How often fingers were to be put back.
  bool stroke = false;                ///< How it moves; else it goes home.
  StrokePlan plan;
  core::RandomStream random{0, "stroke"};
};

/// Program to device: no force, from now until armed again.
struct Halt {};

/// Either way: the connection is over.
struct Goodbye {};

using Content = std::variant<Hello, Welcome, Refusal, State, Command, Order, Halt, Goodbye>;

/// `std::visit` that has nothing to throw: a content always is one of its kinds. Real time.
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

/// Why something is no datagram of ours.
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

/// "wrong_checksum", as JSON spells it. Real time.
[[nodiscard]] std::string_view name(Problem problem) noexcept;

/// What is wrong with bytes that `decode` refuses, a part of a sentence with the kind, the
/// field and its offset: "a welcome whose share of the force at a point (offset 130) is out of
/// its range". "": nothing. Not real time.
[[nodiscard]] std::string problem_words(std::span<const std::byte> bytes);

/// Returns how many bytes were written. Real time.
[[nodiscard]] std::size_t encode(const Datagram& datagram,
                                 std::span<std::byte, kMaxBytes> bytes) noexcept;

/// Takes nothing on trust: what it accepts is finite, within its range, and encodes to the very
/// same bytes. With a problem, `datagram` is undefined. Real time.
[[nodiscard]] Problem decode(std::span<const std::byte> bytes, Datagram& datagram) noexcept;

/// The version that something with our magic claims; 0 without it. Real time.
[[nodiscard]] std::uint16_t version_of(std::span<const std::byte> bytes) noexcept;

/// The size that something of our version claims; 0: it is not of it. Real time.
[[nodiscard]] std::size_t size_of(std::span<const std::byte> bytes) noexcept;

/// Neither hello nor welcome nor refusal, by the kind that it claims. Real time.
[[nodiscard]] bool is_of_stream(std::span<const std::byte> bytes) noexcept;

}  // namespace jnd::device::wire
