#include "device/network/datagram.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <type_traits>

#include "device/network/crc32.h"
#include "device/network/wire_bytes.h"

namespace jnd::device::wire {
namespace {

constexpr std::uint32_t kMagic = 0x4b4c444a;  // "JDLK" in the order of the bytes.
constexpr std::size_t kVersionAt = 4;
constexpr std::size_t kKindAt = 6;
constexpr std::size_t kSizeAt = 20;

static_assert(sizeof(core::RandomStream) == sizeof(std::uint64_t) &&
                  std::is_trivially_copyable_v<core::RandomStream>,
              "a random stream travels as its state");
static_assert(core::kNumContactPoints <= 8, "bits of a byte say which are attached");

// Each content has one function for both directions, so that the order of its fields is written
// once.

template <typename Bytes, typename Flag>
void flag(Bytes& bytes, Flag& value) noexcept {
  std::uint8_t bit = value ? 1 : 0;
  bytes.number(bit);
  if (bit > 1) bytes.refuse(Problem::kOutOfRange);
  if constexpr (Bytes::kReads) value = bit == 1;
}

/// An enumeration with values from `lowest` to `highest`.
template <typename Bytes, typename Enum, typename Limit>
void choice(Bytes& bytes, Enum& value, Limit lowest, Limit highest) noexcept {
  auto number = static_cast<std::uint8_t>(value);
  bytes.number(number);
  if (number < static_cast<std::uint8_t>(lowest) ||
      number > static_cast<std::uint8_t>(highest)) {
    bytes.refuse(Problem::kOutOfRange);
    number = static_cast<std::uint8_t>(lowest);
  }
  if constexpr (Bytes::kReads) value = static_cast<Limit>(number);
}

/// A count, with 32 bits on the wire.
template <typename Bytes, typename Count>
void count(Bytes& bytes, Count& value, std::uint32_t highest) noexcept {
  auto number = static_cast<std::uint32_t>(value);
  bytes.number(number);
  if (number > highest) bytes.refuse(Problem::kOutOfRange);
  if constexpr (Bytes::kReads) value = static_cast<int>(std::min(number, highest));
}

template <typename Bytes, typename Number>
void not_negative(Bytes& bytes, Number& value) noexcept {
  bytes.number(value);
  if (!(value >= 0)) bytes.refuse(Problem::kOutOfRange);
}

template <typename Bytes, typename Number>
void positive(Bytes& bytes, Number& value) noexcept {
  bytes.number(value);
  if (!(value > 0)) bytes.refuse(Problem::kOutOfRange);
}

template <typename Bytes, typename Vector>
void vector(Bytes& bytes, Vector& value) noexcept {
  for (int axis = 0; axis < 3; ++axis) bytes.number(value[axis]);
}

template <typename Bytes, typename Bits>
void bits(Bytes& bytes, Bits& values) noexcept {
  std::uint8_t packed = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    packed = static_cast<std::uint8_t>(packed | (values[i] ? 1 : 0) << i);
  }
  bytes.number(packed);
  if (packed >> values.size() != 0) bytes.refuse(Problem::kOutOfRange);
  if constexpr (Bytes::kReads) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = (packed >> i & 1) != 0;
  }
}

/// An infinite number is 0 on the wire: the device does not say.
template <typename Bytes, typename Number>
void positive_or_unsaid(Bytes& bytes, Number& value) noexcept {
  double number = std::isfinite(value) ? value : 0.0;
  bytes.number(number);
  if (!(number >= 0.0)) bytes.refuse(Problem::kOutOfRange);
  if constexpr (Bytes::kReads) value = number > 0.0 ? number : core::kInfinity;
}

/// One bit for each existing point, with 32 bits on the wire. The shares come later.
template <typename Bytes, typename Shares>
std::uint32_t point_bits(Bytes& bytes, const Shares& shares) noexcept {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) bits |= (shares[i] > 0.0 ? 1U : 0U) << i;
  bytes.number(bits);
  if (bits == 0 || bits >> shares.size() != 0) bytes.refuse(Problem::kOutOfRange);
  return bits;
}

template <typename Bytes, typename Shares>
void share_ratios(Bytes& bytes, std::uint32_t bits, Shares& shares) noexcept {
  constexpr double kMostOff = 1e-3;
  double sum = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    bytes.number(shares[i]);
    const bool is_there = (bits >> i & 1U) != 0;
    if (is_there ? !(shares[i] > 0.0) : !(shares[i] == 0.0)) {
      bytes.refuse(Problem::kOutOfRange);
    }
    sum += shares[i];
  }
  if (!(std::abs(sum - 1.0) <= kMostOff)) bytes.refuse(Problem::kOutOfRange);
  if constexpr (Bytes::kReads) shares = core::normalised_shares(shares);
}

template <typename Bytes, typename Channels>
void channel_values(Bytes& bytes, Channels& channels) noexcept {
  for (auto& force_n : channels.force_n) vector(bytes, force_n);
  for (auto& part : channels.orientation_wxyz) bytes.number(part);
  vector(bytes, channels.torque_n_m);
  bytes.number(channels.gripper_m);
  bytes.number(channels.buttons);
}

/// 0: moved by a person; 1: moves as ordered; 2: moves as it likes.
template <typename Bytes, typename Flag>
void movement(Bytes& bytes, Flag& by_itself, Flag& takes_orders) noexcept {
  std::uint8_t kind = by_itself ? (takes_orders ? 1 : 2) : 0;
  bytes.number(kind);
  if (kind > 2) bytes.refuse(Problem::kOutOfRange);
  if constexpr (Bytes::kReads) {
    by_itself = kind != 0;
    takes_orders = kind != 2;
  }
}

template <typename Bytes, typename Text>
void device_text(Bytes& bytes, Text& text) noexcept {
  bool ended = false;
  for (auto& letter : text) {
    auto byte = static_cast<std::uint8_t>(letter);
    bytes.number(byte);
    const bool is_printable = byte >= 0x20 && byte < 0x7f;
    if (ended ? byte != 0 : byte != 0 && !is_printable) bytes.refuse(Problem::kOutOfRange);
    ended |= byte == 0;
    if constexpr (Bytes::kReads) letter = static_cast<char>(byte);
  }
}

template <typename Bytes, typename HeaderT>
void header_fields(Bytes& bytes, HeaderT& header) noexcept {
  bytes.number(header.sent_ns);
  bytes.number(header.echo_ns);
}

template <typename Bytes, typename T>
requires std::same_as<std::remove_const_t<T>, Hello>
void fields(Bytes& bytes, T& hello) noexcept {
  bytes.number(hello.token);
  flag(bytes, hello.only_asks);
  bytes.number(hello.challenge);
  positive(bytes, hello.rate_hz);
}

template <typename Bytes, typename T>
requires std::same_as<std::remove_const_t<T>, Welcome>
void fields(Bytes& bytes, T& welcome) noexcept {
  auto& can = welcome.capabilities;
  bytes.number(welcome.token);
  positive(bytes, can.rate_hz);
  positive(bytes, can.max_force_per_point_n);
  positive(bytes, can.max_total_force_n);
  not_negative(bytes, can.max_stale_s);
  if (!(can.max_stale_s <= kMostStale_s)) bytes.refuse(Problem::kOutOfRange);
  const std::uint32_t points = point_bits(bytes, can.share_ratio);
  count(bytes, can.num_joints, core::kNumJoints);
  flag(bytes, can.simulated);
  movement(bytes, can.moves_by_itself, can.takes_orders);
  device_text(bytes, welcome.name);
  bytes.number(welcome.challenge);
  share_ratios(bytes, points, can.share_ratio);
  positive_or_unsaid(bytes, can.max_slew_n_per_s);
  positive_or_unsaid(bytes, can.max_speed_m_per_s);
  positive_or_unsaid(bytes, can.workspace.half_width_x_m);
  positive_or_unsaid(bytes, can.workspace.half_width_y_m);
  positive_or_unsaid(bytes, can.workspace.half_width_z_m);
  not_negative(bytes, can.own_mass_kg);
  not_negative(bytes, can.own_damping_n_s_per_m);
  not_negative(bytes, can.closed_loop_delay_s);
  bytes.number(can.channels);
  if ((can.channels & ~core::kAllChannels) != 0) bytes.refuse(Problem::kOutOfRange);
  flag(bytes, can.has_enable_switch);
  device_text(bytes, welcome.serial);
  device_text(bytes, welcome.firmware);
}

template <typename Bytes, typename T>
requires std::same_as<std::remove_const_t<T>, Refusal>
void fields(Bytes& bytes, T& refusal) noexcept {
  bytes.number(refusal.token);
  choice(bytes, refusal.reason, RefusalReason::kBusy, RefusalReason::kOtherKey);
}

template <typename Bytes, typename T>
requires std::same_as<std::remove_const_t<T>, State>
void fields(Bytes& bytes, T& state) noexcept {
  auto& measured = state.measured;
  bytes.number(measured.device_time_ns);
  for (auto& tip : measured.tip_position_m) vector(bytes, tip);
  for (auto& tip : measured.tip_velocity_m_per_s) vector(bytes, tip);
  vector(bytes, measured.end_effector_position_m);
  for (auto& joint : measured.joint_position_rad) bytes.number(joint);
  for (auto& joint : measured.joint_torque_n_m) bytes.number(joint);
  not_negative(bytes, state.contact_sums.num_ticks);
  bytes.number(state.contact_sums.opposing_n);
  bytes.number(state.contact_sums.rendered_opposing_n);
  bytes.number(state.contact_sums.speed_m_per_s);
  not_negative(bytes, state.strokes_finished);
  bytes.number(state.armed_number);
  bytes.number(state.order_number);
  bits(bytes, measured.attached);
  flag(bytes, state.armed);
  flag(bytes, state.is_measured);
  flag(bytes, state.is_home);
  choice(bytes, state.fault, core::Fault::kNone, core::kLastFault);
  choice(bytes, state.level, LinkLevel::kUnacceptable, LinkLevel::kExcellent);
  for (auto& force : measured.acted_n) vector(bytes, force);
  flag(bytes, measured.enabled);
  channel_values(bytes, measured.channels);
}

template <typename Bytes, typename T>
requires std::same_as<std::remove_const_t<T>, Command>
void fields(Bytes& bytes, T& command) noexcept {
  bytes.number(command.arm_number);
  bytes.number(command.answered_sequence);
  for (auto& force : command.force_on_hand_n) vector(bytes, force);
}

template <typename Bytes, typename T>
requires std::same_as<std::remove_const_t<T>, Order>
void fields(Bytes& bytes, T& order) noexcept {
  bytes.number(order.number);
  bytes.number(order.movement_number);
  bytes.number(order.num_put_back);
  flag(bytes, order.stroke);
  auto& plan = order.plan;
  bytes.number(plan.amplitude_m);
  bytes.number(plan.max_speed_m_per_s);
  bytes.number(plan.height_m);
  bytes.number(plan.lift_m);
  bytes.number(plan.amplitude_sd_ratio);
  bytes.number(plan.speed_sd_ratio);
  bytes.number(plan.height_sd_m);
  bytes.number(plan.sideways_sd_m);
  bytes.number(plan.num_strokes);
  if (!is_valid(plan)) bytes.refuse(Problem::kOutOfRange);
  auto state = std::bit_cast<std::uint64_t>(order.random);
  bytes.number(state);
  if constexpr (Bytes::kReads) order.random = std::bit_cast<core::RandomStream>(state);
}

template <typename Bytes, typename T>
requires std::same_as<std::remove_const_t<T>, Halt> ||
    std::same_as<std::remove_const_t<T>, Goodbye>
void fields(Bytes&, T&) noexcept {}

/// Makes the content of this kind, which is the number of an alternative, from 1. Returns false
/// if there is none.
template <std::size_t kKind = 1>
bool make_content(std::uint16_t kind, Content& content) noexcept {
  if constexpr (kKind <= std::variant_size_v<Content>) {
    if (kind != kKind) return make_content<kKind + 1>(kind, content);
    content = Content(std::in_place_index<kKind - 1>);
    return true;
  }
  return false;
}

}  // namespace

std::string_view name(Problem problem) noexcept {
  switch (problem) {
    case Problem::kNone:
      return "none";
    case Problem::kTooShort:
      return "too_short";
    case Problem::kWrongMagic:
      return "wrong_magic";
    case Problem::kWrongVersion:
      return "wrong_version";
    case Problem::kWrongSize:
      return "wrong_size";
    case Problem::kWrongChecksum:
      return "wrong_checksum";
    case Problem::kUnknownKind:
      return "unknown_kind";
    case Problem::kNotFinite:
      return "not_finite";
    case Problem::kOutOfRange:
      return "out_of_range";
    case Problem::kOtherKey:
      return "other_key";
  }
  return "unknown";
}

std::size_t encode(const Datagram& datagram, std::span<std::byte, kMaxBytes> bytes) noexcept {
  ByteWriter contents(bytes.subspan(kHeaderBytes));
  visit_content(datagram.content,
                [&contents](const auto& content) { fields(contents, content); });
  const std::size_t end = kHeaderBytes + contents.size();

  const Header& header = datagram.header;
  ByteWriter head(bytes);
  head.number(kMagic);
  head.number(kVersion);
  head.number(static_cast<std::uint16_t>(datagram.content.index() + 1));
  head.number(header.stream_id);
  head.number(header.sequence);
  head.number(static_cast<std::uint32_t>(end + kChecksumBytes));
  header_fields(head, header);

  ByteWriter tail(bytes.subspan(end));
  tail.number(crc32(bytes.first(end)));
  return end + kChecksumBytes;
}

std::uint16_t version_of(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kVersionAt + sizeof(std::uint16_t)) return 0;
  ByteReader head(bytes);
  std::uint32_t magic = 0;
  std::uint16_t version = 0;
  head.number(magic);
  head.number(version);
  return magic == kMagic ? version : std::uint16_t{0};
}

std::size_t size_of(std::span<const std::byte> bytes) noexcept {
  if (version_of(bytes) != kVersion || bytes.size() < kHeaderBytes) return 0;
  ByteReader head(bytes.subspan(kSizeAt));
  std::uint32_t size = 0;
  head.number(size);
  return size;
}

bool is_of_stream(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kHeaderBytes) return false;
  ByteReader head(bytes.subspan(kKindAt));
  std::uint16_t kind = 0;
  head.number(kind);
  constexpr std::uint16_t kRefusal = 3;
  return kind > kRefusal;
}

Problem decode(std::span<const std::byte> bytes, Datagram& datagram) noexcept {
  if (bytes.size() < kHeaderBytes + kChecksumBytes) return Problem::kTooShort;
  const std::size_t end = bytes.size() - kChecksumBytes;
  ByteReader head(bytes.first(kHeaderBytes));
  std::uint32_t magic = 0;
  std::uint32_t size = 0;
  std::uint16_t version = 0;
  std::uint16_t kind = 0;
  head.number(magic);
  head.number(version);
  head.number(kind);
  head.number(datagram.header.stream_id);
  head.number(datagram.header.sequence);
  head.number(size);
  header_fields(head, datagram.header);
  if (magic != kMagic) return Problem::kWrongMagic;
  if (version != kVersion) return Problem::kWrongVersion;
  if (size != bytes.size()) return Problem::kWrongSize;

  std::uint32_t checksum = 0;
  ByteReader tail(bytes.subspan(end));
  tail.number(checksum);
  if (checksum != crc32(bytes.first(end))) return Problem::kWrongChecksum;
  if (!make_content(kind, datagram.content)) return Problem::kUnknownKind;

  ByteReader contents(bytes.subspan(kHeaderBytes, end - kHeaderBytes));
  visit_content(datagram.content, [&contents](auto& content) { fields(contents, content); });
  return contents.problem();
}

namespace {

/// By device/network/README.md, where a field of a kind begins.
struct FieldPlace {
  std::uint16_t kind;
  std::size_t offset;
  std::string_view name;
};
constexpr std::uint16_t kWelcomeKind = 2, kStateKind = 4;
constexpr std::array kFieldPlaces = {
    FieldPlace{kWelcomeKind, 40, "token"},
    FieldPlace{kWelcomeKind, 48, "rate"},
    FieldPlace{kWelcomeKind, 56, "most force at a point"},
    FieldPlace{kWelcomeKind, 64, "most force in all"},
    FieldPlace{kWelcomeKind, 72, "time for which a measurement may stand in"},
    FieldPlace{kWelcomeKind, 80, "set of contact points"},
    FieldPlace{kWelcomeKind, 84, "number of joints"},
    FieldPlace{kWelcomeKind, 88, "flag of a simulation"},
    FieldPlace{kWelcomeKind, 89, "number that says who moves it"},
    FieldPlace{kWelcomeKind, 90, "name in printable ASCII"},
    FieldPlace{kWelcomeKind, 122, "challenge"},
    FieldPlace{kWelcomeKind, 130, "share of the force at a point (together 1)"},
    FieldPlace{kWelcomeKind, 170, "change of the force that it follows"},
    FieldPlace{kWelcomeKind, 178, "largest speed"},
    FieldPlace{kWelcomeKind, 186, "half width of the workspace"},
    FieldPlace{kWelcomeKind, 210, "own mass"},
    FieldPlace{kWelcomeKind, 218, "own damping"},
    FieldPlace{kWelcomeKind, 226, "delay"},
    FieldPlace{kWelcomeKind, 234, "set of what it measures"},
    FieldPlace{kWelcomeKind, 235, "flag of an enabling switch"},
    FieldPlace{kWelcomeKind, 236, "serial number in printable ASCII"},
    FieldPlace{kWelcomeKind, 268, "firmware in printable ASCII"},
    FieldPlace{kStateKind, 40, "time of the measurement"},
    FieldPlace{kStateKind, 48, "position of a point"},
    FieldPlace{kStateKind, 168, "velocity of a point"},
    FieldPlace{kStateKind, 288, "position of the end effector"},
    FieldPlace{kStateKind, 312, "joint angle"},
    FieldPlace{kStateKind, 488, "joint torque"},
    FieldPlace{kStateKind, 664, "sum over ticks"},
    FieldPlace{kStateKind, 696, "number of strokes"},
    FieldPlace{kStateKind, 704, "number of the arming or of the order"},
    FieldPlace{kStateKind, 712, "set of points that are held"},
    FieldPlace{kStateKind, 713, "flag `armed`"},
    FieldPlace{kStateKind, 714, "flag `measured`"},
    FieldPlace{kStateKind, 715, "flag of a hand at home"},
    FieldPlace{kStateKind, 716, "number of a fault"},
    FieldPlace{kStateKind, 717, "level of the connection"},
    FieldPlace{kStateKind, 718, "force that acted"},
    FieldPlace{kStateKind, 838, "flag `enabled`"},
    FieldPlace{kStateKind, 839, "measured force"},
    FieldPlace{kStateKind, 959, "orientation"},
    FieldPlace{kStateKind, 991, "torque"},
    FieldPlace{kStateKind, 1015, "opening of the gripper"},
    FieldPlace{kStateKind, 1023, "set of buttons"}};

std::string kind_words(std::uint16_t kind) {
  constexpr std::array<std::string_view, std::variant_size_v<Content>> kKindNames = {
      "hello", "welcome", "refusal", "state", "command", "order", "halt", "goodbye"};
  if (kind == 0 || kind > kKindNames.size()) return "kind " + std::to_string(kind);
  return std::string(kKindNames[kind - 1U]);
}

std::string field_words(std::uint16_t kind, std::size_t offset) {
  std::string_view found = "value";
  for (const FieldPlace& place : kFieldPlaces) {
    if (place.kind == kind && place.offset <= offset) found = place.name;
  }
  return std::string(found) + " (offset " + std::to_string(offset) + ")";
}

}  // namespace

std::string problem_words(std::span<const std::byte> bytes) {
  Datagram datagram;
  const Problem problem = decode(bytes, datagram);
  const std::string size = std::to_string(bytes.size());
  if (problem == Problem::kNone) return "";
  if (problem == Problem::kTooShort) return "one of " + size + " bytes, which holds no header";
  if (problem == Problem::kWrongMagic) {
    return "one of " + size + " bytes that does not begin with the letters JDLK";
  }
  ByteReader head(bytes.subspan(kKindAt));
  std::uint16_t kind = 0;
  head.number(kind);
  const std::string what = "a datagram `" + kind_words(kind) + "` of " + size + " bytes";
  ByteReader head_of_size(bytes.subspan(kSizeAt));
  std::uint32_t size_told = 0;
  head_of_size.number(size_told);
  switch (problem) {
    case Problem::kWrongVersion:
      return "a datagram of version " + std::to_string(version_of(bytes));
    case Problem::kWrongSize:
      return what + (size_told == bytes.size()
                         ? ", which is not the size of this kind"
                         : " whose header says " + std::to_string(size_told));
    case Problem::kWrongChecksum:
      return what + " whose last four bytes are not its CRC-32";
    case Problem::kUnknownKind:
      return what + ", of which there is no such kind";
    case Problem::kNotFinite:
    case Problem::kOutOfRange:
      break;
    default:
      return what + " with " + std::string(name(problem));
  }
  ByteReader contents(
      bytes.subspan(kHeaderBytes, bytes.size() - kChecksumBytes - kHeaderBytes));
  visit_content(datagram.content, [&contents](auto& content) { fields(contents, content); });
  return what + " whose " + field_words(kind, kHeaderBytes + contents.problem_at()) +
         (problem == Problem::kNotFinite ? " is not finite" : " is out of its range");
}

}  // namespace jnd::device::wire
