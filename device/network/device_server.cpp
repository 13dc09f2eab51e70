#include "device/network/device_server.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/require.h"
#include "device/simulated_hand.h"

namespace jnd::device {
namespace {

using core::Fault;

/// More than arrive in a step, but few enough that a flood costs no step.
constexpr int kMostTakenByServer = 256;

std::int64_t nanoseconds(double duration_s, const char* field) {
  core::require(duration_s > 0.0 && duration_s <= 3600.0, field, "a number in (0, 3600]",
                duration_s);
  return std::llround(1e9 * duration_s);
}

core::ForceLimiter::Parameters limits_of(const DeviceCapabilities& can, double slew_n_per_s) {
  core::ForceLimiter::Parameters limits;
  limits.per_point_n = can.max_force_per_point_n;
  limits.total_n = can.max_total_force_n;
  limits.slew_n_per_s = std::min(slew_n_per_s, can.max_slew_n_per_s);
  limits.max_speed_m_per_s = std::min(limits.max_speed_m_per_s, can.max_speed_m_per_s);
  return limits;
}

/// Returns as much of the words as there is room for.
wire::DeviceText text_of(std::string_view words) noexcept {
  wire::DeviceText text{};
  std::copy_n(words.begin(), std::min(words.size(), text.size()), text.begin());
  return text;
}

/// Enters what the device says about itself, which may be complete only once it is open.
void introduce(const HapticDevice& device, wire::Welcome& welcome) {
  const DeviceIdentity identity = device.identity();
  welcome.name = text_of(identity.model);
  welcome.serial = text_of(identity.serial);
  welcome.firmware = text_of(identity.firmware);
}

/// A state may be late for as long as a command.
wire::Welcome welcome_of(HapticDevice& device, double watchdog_s) {
  wire::Welcome welcome{.capabilities = device.capabilities()};
  double& max_stale_s = welcome.capabilities.max_stale_s;
  max_stale_s = std::min(std::max(max_stale_s, watchdog_s), wire::kMostStale_s);
  introduce(device, welcome);
  welcome.capabilities.takes_orders &= device.simulated_hand() != nullptr;
  return welcome;
}

bool is_finite(const core::HapticState& state) noexcept {
  bool finite = state.end_effector_position_m.allFinite();
  for (const Eigen::Vector3d& position : state.tip_position_m) finite &= position.allFinite();
  for (const Eigen::Vector3d& velocity : state.tip_velocity_m_per_s) {
    finite &= velocity.allFinite();
  }
  for (const Eigen::Vector3d& force : state.acted_n) finite &= force.allFinite();
  for (const double angle : state.joint_position_rad) finite &= std::isfinite(angle);
  for (const double torque : state.joint_torque_n_m) finite &= std::isfinite(torque);
  return finite && (state.channels.bits == 0 || core::is_sound(state.channels));
}

bool is_finite(const core::ContactSums& sums) noexcept {
  return sums.num_ticks >= 0 && std::isfinite(sums.opposing_n) &&
         std::isfinite(sums.rendered_opposing_n) && std::isfinite(sums.speed_m_per_s);
}

bool is_without_force(const wire::Command& command) noexcept {
  return std::all_of(command.force_on_hand_n.begin(), command.force_on_hand_n.end(),
                     [](const Eigen::Vector3d& force) { return force.isZero(0.0); });
}

}  // namespace

DeviceServer::DeviceServer(HapticDevice& device, DatagramPort& port,
                           const Parameters& parameters)
    : device_(device),
      port_(port),
      parameters_(parameters),
      watchdog_ns_(nanoseconds(parameters.watchdog_s, "watchdog_s")),
      client_timeout_ns_(nanoseconds(parameters.client_timeout_s, "client_timeout_s")),
      max_answer_age_ns_(nanoseconds(parameters.max_answer_age_s, "max_answer_age_s")),
      max_answer_age_(static_cast<std::uint32_t>(std::ceil(
          1e-9 * static_cast<double>(max_answer_age_ns_) * device.capabilities().rate_hz))),
      welcome_(welcome_of(device, parameters.watchdog_s)),
      limiter_(limits_of(device.capabilities(), parameters.slew_n_per_s),
               1.0 / device.capabilities().rate_hz),
      sent_ns_(std::bit_ceil(max_answer_age_ + std::size_t{1})),
      tells_acting_force_(device.capabilities().tells_acting_force),
      seal_(DatagramSeal::Side::kDevice, parameters.key),
      next_stream_id_(parameters.first_stream_id),
      sequence_(parameters.first_sequence) {
  welcome_.challenge = parameters.first_challenge;
  if (!tells_acting_force_ && !device.capabilities().simulated) {
    throw core::Error(std::string(device.name()) +
                      ": expected a real device to tell which force acted while it measured, "
                      "found that it does not; nobody could see it push a hand");
  }
}

void DeviceServer::step(std::int64_t now_ns) noexcept {
  ++counts_.num_steps;
  num_welcomed_in_step_ = 0;
  refused_in_step_ = false;
  take_in(now_ns);
  if (client_ && counts_.num_steps % steps_per_command_ == 0) quality_.end_tick();
  watch_own_pace(now_ns);
  watch(now_ns);
  measure();
  apply_force();
  tell_client(now_ns);
}

void DeviceServer::dismiss(std::int64_t now_ns) noexcept {
  // It is sent twice, because there is no answer. The program would also notice the silence.
  for (int i = 0; client_ && i < 2; ++i) {
    send(client_->address, client_->stream_id, wire::Goodbye{}, now_ns);
  }
  part_with_client();
  apply_force();
}

void DeviceServer::renew_device() {
  if (!was_used_) return;
  device_.close();
  device_.open();
  introduce(device_, welcome_);
  was_used_ = false;
}

void DeviceServer::take_in(std::int64_t now_ns) noexcept {
  std::array<std::byte, 2 * wire::kMaxBytes> bytes;
  Address from;
  for (int i = 0; i < kMostTakenByServer; ++i) {
    const std::size_t size = port_.receive(bytes, from);
    if (size == 0) return;
    const std::span<const std::byte> received = std::span(bytes).first(size);
    const wire::Problem problem = seal_.read(received, incoming_);
    if (problem != wire::Problem::kNone) {
      quality_.refused();
      if (problem == wire::Problem::kWrongVersion) {
        hint(from, wire::RefusalReason::kOtherVersion, now_ns);
      } else if (problem == wire::Problem::kOtherKey && !wire::is_of_stream(received)) {
        hint(from, wire::RefusalReason::kOtherKey, now_ns);
      }
      continue;
    }
    if (const auto* hello = std::get_if<wire::Hello>(&incoming_.content)) {
      take(*hello, from, now_ns);
    } else if (client_ && from == client_->address &&
               incoming_.header.stream_id == client_->stream_id) {
      take_from_client(incoming_.header, incoming_.content, now_ns);
    } else if (!seal_.has_key() && std::holds_alternative<wire::Command>(incoming_.content)) {
      // With a key there is no answer, because an eavesdropper could have it sealed for later
      // use.
      refuse(from, incoming_.header.stream_id, {.reason = wire::RefusalReason::kUnknownStream},
             now_ns);
    }
  }
}

void DeviceServer::refuse(const Address& to, std::uint64_t stream_id,
                          const wire::Refusal& refusal, std::int64_t now_ns) noexcept {
  if (refused_in_step_) return;
  refused_in_step_ = true;
  send(to, stream_id, refusal, now_ns);
}

/// Answers a sender whom we do not understand, without a seal, so that people can read the
/// reason.
void DeviceServer::hint(const Address& to, wire::RefusalReason reason,
                        std::int64_t now_ns) noexcept {
  if (refused_in_step_) return;
  refused_in_step_ = true;
  std::array<std::byte, wire::kMaxBytes> bytes;
  const std::size_t size = wire::encode(
      {.header = {.sent_ns = now_ns}, .content = wire::Refusal{.reason = reason}}, bytes);
  port_.send(std::span(bytes).first(size), to);
}

void DeviceServer::take(const wire::Hello& hello, const Address& from,
                        std::int64_t now_ns) noexcept {
  const bool is_known = client_ && from == client_->address;
  if (client_ && !is_known && !hello.only_asks) {
    ++counts_.num_turned_away;
    // The challenge of a refused hello must not be valid later.
    if (hello.challenge == welcome_.challenge) ++welcome_.challenge;
    return refuse(from, 0, {.token = hello.token, .reason = wire::RefusalReason::kBusy},
                  now_ns);
  }
  // If the same hello comes again, our answer was lost.
  const bool is_again = is_known && hello.token == client_->token;
  // An old hello that somebody recorded opens nothing.
  const bool opens = !hello.only_asks && (is_again || hello.challenge == welcome_.challenge);
  // Anybody can repeat a hello that opens nothing new. It must not use up the answers to
  // others.
  constexpr int kMostWelcomes = 8;
  if ((!opens || is_again) && ++num_welcomed_in_step_ > kMostWelcomes) return;
  welcome_.token = hello.token;
  if (!opens) return send(from, 0, welcome_, now_ns);
  if (!is_again) {
    end_session();
    ++welcome_.challenge;
    if (next_stream_id_ == 0) next_stream_id_ = 1;
    client_ = Client{.address = from,
                     .token = hello.token,
                     .stream_id = next_stream_id_++,
                     .last_heard_ns = now_ns};
    seal_.begin_stream(client_->token, client_->stream_id);
    ++counts_.num_clients;
    quality_.restart(hello.rate_hz);
    steps_per_command_ = std::max<std::int64_t>(
        1, std::lround(std::min(welcome_.capabilities.rate_hz / hello.rate_hz, 1000.0)));
    sequence_ = parameters_.first_sequence;
    state_.armed_number = 0;
    state_.order_number = 0;
    state_.fault = Fault::kNone;
  }
  send(from, client_->stream_id, welcome_, now_ns);
}

void DeviceServer::take_from_client(const wire::Header& header, const wire::Content& content,
                                    std::int64_t now_ns) noexcept {
  const LinkQuality::Verdict verdict = quality_.received(header.sequence);
  if (verdict == LinkQuality::Verdict::kRepeated) return;
  client_->last_heard_ns = now_ns;
  if (verdict == LinkQuality::Verdict::kNewest) {
    client_->last_sent_ns = header.sent_ns;
    quality_.echoed(header.echo_ns, now_ns);
  }
  if (const auto* command = std::get_if<wire::Command>(&content)) {
    take(header, *command, now_ns);
  } else if (const auto* order = std::get_if<wire::Order>(&content)) {
    take(*order);
  } else if (std::holds_alternative<wire::Halt>(content)) {
    disarm(Fault::kWatchdog);
  } else if (std::holds_alternative<wire::Goodbye>(content)) {
    part_with_client();
  }
}

void DeviceServer::take(const wire::Header& header, const wire::Command& command,
                        std::int64_t now_ns) noexcept {
  Client& client = *client_;
  const auto ahead = static_cast<std::int32_t>(header.sequence - client.command_sequence);
  if (client.commanded && ahead <= 0) return;
  client.commanded = client.is_recent = true;
  client.command_sequence = header.sequence;
  client.command_ns = now_ns;
  client.command = command;
}

void DeviceServer::take(const wire::Order& order) noexcept {
  SimulatedHand* hand = device_.simulated_hand();
  if (hand == nullptr || order.number <= state_.order_number) return;
  state_.order_number = order.number;
  if (order.num_put_back > client_->num_put_back) hand->put_fingers_back();
  client_->num_put_back = order.num_put_back;
  if (order.movement_number <= client_->movement_number) return;
  client_->movement_number = order.movement_number;
  if (order.stroke) {
    // This does not throw, because the parser accepts only valid plans.
    hand->begin_strokes(order.plan, order.random);
  } else {
    hand->go_home();
  }
}

/// If the whole machine was held up, what waits here may be as old as the pause. Its age is
/// unknown, because our own states stood still, too.
void DeviceServer::watch_own_pace(std::int64_t now_ns) noexcept {
  const std::int64_t pause_ns = now_ns - last_step_ns_.value_or(now_ns);
  last_step_ns_ = now_ns;
  if (pause_ns < watchdog_ns_) return;
  disarm(Fault::kWatchdog);
  if (client_) client_->is_recent = false;
}

void DeviceServer::suspended() noexcept {
  disarm(Fault::kSuspended);
  if (client_) client_->is_recent = false;
}

void DeviceServer::watch(std::int64_t now_ns) noexcept {
  if (!client_) return;
  if (now_ns - client_->last_heard_ns >= client_timeout_ns_) return part_with_client();
  arm_or_disarm(now_ns);
  if (!armed_) return;
  if (now_ns - client_->command_ns >= watchdog_ns_ || !answers_in_time(now_ns) ||
      quality_.is_broken() || quality_.level() == LinkLevel::kUnacceptable) {
    disarm(Fault::kLinkLost);
  }
}

/// In time, and not in steps alone: a machine that misses most of its steps sends few states,
/// and an answer to one of few is old. There is a place for each number within those steps.
bool DeviceServer::answers_in_time(std::int64_t now_ns) const noexcept {
  const std::uint32_t answered = client_->command.answered_sequence;
  const std::uint32_t age = sequence_ - answered;
  return age <= max_answer_age_ && now_ns - sent_ns_[place_of(answered)] <= max_answer_age_ns_;
}

void DeviceServer::arm_or_disarm(std::int64_t now_ns) noexcept {
  const wire::Command& command = client_->command;
  if (!client_->is_recent || command.arm_number == state_.armed_number) return;
  // The command asks for another arming, so it does not mean the force of the one before.
  armed_ = false;
  if (quality_.is_broken()) quality_.judge_anew();
  if (command.arm_number == 0 || !is_without_force(command) || !quality_.is_settled() ||
      !answers_in_time(now_ns) || !state_.is_measured) {
    return;
  }
  armed_ = true;
  state_.armed_number = command.arm_number;
  state_.fault = Fault::kNone;
  limiter_.rearm();
  ++counts_.num_armings;
}

void DeviceServer::disarm(Fault fault) noexcept {
  if (armed_) {
    ++counts_.num_disarmings;
    counts_.last_fault = fault;
    state_.fault = fault;
  }
  armed_ = false;
}

void DeviceServer::measure() noexcept {
  core::HapticState measured;
  state_.is_measured = device_.read(measured);
  Fault fault = device_.fault() != Fault::kNone ? device_.fault() : Fault::kDeviceReadFailed;
  if (state_.is_measured && !is_finite(measured)) {
    state_.is_measured = false;
    fault = Fault::kNonFiniteState;
  }
  if (state_.is_measured) {
    if (state_.measured.enabled && !measured.enabled) disarm(Fault::kNotEnabled);
    state_.measured = measured;
    if (!tells_acting_force_) state_.measured.acted_n = written_n_;
  } else {
    disarm(fault);
    state_.fault = fault;
  }
}

void DeviceServer::apply_force() noexcept {
  core::PointVectors force_on_hand_n = core::zero_vectors();
  const bool is_enabled = state_.measured.enabled;
  // A person who closes the switch must not meet a force that waited for it.
  if (armed_ && is_enabled && !was_enabled_ && !is_without_force(client_->command)) {
    disarm(Fault::kNotEnabled);
  }
  was_enabled_ = is_enabled;
  if (armed_ && is_enabled) {
    force_on_hand_n = client_->command.force_on_hand_n;
    // A request for zero force takes effect at once, because the slew must not delay a stop.
    if (is_without_force(client_->command)) limiter_.rearm();
    (void)limiter_.limit(state_.measured.attached, state_.measured.tip_velocity_m_per_s,
                         force_on_hand_n);
    if (limiter_.fault() != Fault::kNone) disarm(limiter_.fault());
  }
  written_n_ = force_on_hand_n;
  if (device_.write(force_on_hand_n)) {
    num_failed_writes_ = 0;
    return;
  }
  disarm(device_.fault() != Fault::kNone ? device_.fault() : Fault::kDeviceWriteFailed);
  // Otherwise the last force would persist. The halt is repeated as often as the loop does for
  // a local device.
  constexpr int kNumHalts = 10;
  if (num_failed_writes_ < kNumHalts) device_.halt();
  num_failed_writes_ = std::min(num_failed_writes_ + 1, kNumHalts);
}

void DeviceServer::tell_client(std::int64_t now_ns) noexcept {
  if (!client_) return;
  const core::ContactSums sums = device_.contact_sums();
  if (is_finite(sums)) state_.contact_sums = sums;
  if (const SimulatedHand* hand = device_.simulated_hand()) {
    state_.strokes_finished = hand->strokes_finished();
    state_.is_home = hand->is_home();
  }
  state_.armed = armed_;
  state_.level = quality_.level();
  send(client_->address, client_->stream_id, state_, now_ns);
}

/// This does not apply to a program whose connection broke off and that says hello again: the
/// hand continues for it.
void DeviceServer::part_with_client() noexcept {
  was_used_ |= client_.has_value();
  end_session();
}

void DeviceServer::end_session() noexcept {
  armed_ = false;
  if (!client_) return;
  client_.reset();
  if (SimulatedHand* hand = device_.simulated_hand()) hand->go_home();
}

void DeviceServer::send(const Address& to, std::uint64_t stream_id,
                        const wire::Content& content, std::int64_t now_ns) noexcept {
  // The receiver of a welcome or refusal has no stream yet, or no longer.
  const bool is_of_stream = std::holds_alternative<wire::State>(content) ||
                            std::holds_alternative<wire::Goodbye>(content);
  if (is_of_stream) sent_ns_[place_of(sequence_)] = now_ns;
  const wire::Datagram datagram{.header = {.stream_id = stream_id,
                                           .sequence = is_of_stream ? sequence_++ : 0,
                                           .sent_ns = now_ns,
                                           .echo_ns = is_of_stream ? client_->last_sent_ns : 0},
                                .content = content};
  std::array<std::byte, DatagramSeal::kMostBytes> bytes;
  const std::size_t size = seal_.write(datagram, bytes);
  port_.send(std::span(bytes).first(size), to);
}

}  // namespace jnd::device
