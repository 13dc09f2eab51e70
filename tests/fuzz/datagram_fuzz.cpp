#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "device/network/crc32.h"
#include "device/network/datagram.h"
#include "device/stroking_arm.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
namespace wire = device::wire;

void check_finite(const core::PointVectors& vectors) {
  for (const Eigen::Vector3d& vector : vectors) {
    fuzz::property(vector.allFinite(), "what was accepted is finite");
  }
}

void check_content(const wire::Datagram& datagram) {
  if (const auto* state = std::get_if<wire::State>(&datagram.content)) {
    check_finite(state->measured.tip_position_m);
    check_finite(state->measured.tip_velocity_m_per_s);
    for (const double torque : state->measured.joint_torque_n_m) {
      fuzz::property(std::isfinite(torque), "what was accepted is finite");
    }
    fuzz::check_sentence(std::string(core::words(state->fault)));
    fuzz::property(device::name(state->level) != "unknown", "a level has a name");
  } else if (const auto* command = std::get_if<wire::Command>(&datagram.content)) {
    check_finite(command->force_on_hand_n);
  } else if (const auto* order = std::get_if<wire::Order>(&datagram.content)) {
    device::require_valid(order->plan);
  } else if (const auto* welcome = std::get_if<wire::Welcome>(&datagram.content)) {
    const auto end = std::find(welcome->name.begin(), welcome->name.end(), '\0');
    if (end != welcome->name.begin()) {
      fuzz::check_sentence({welcome->name.begin(), end});
    }
    fuzz::property(welcome->capabilities.max_force_per_point_n > 0.0, "a limit is positive");
  }
}

void check(std::span<const std::byte> bytes) {
  wire::Datagram datagram;
  const wire::Problem problem = wire::decode(bytes, datagram);
  fuzz::property(wire::name(problem) != "unknown", "a problem has a name");
  if (problem != wire::Problem::kNone) return;
  check_content(datagram);
  std::array<std::byte, wire::kMaxBytes> again;
  const std::size_t size = wire::encode(datagram, again);
  fuzz::property(std::ranges::equal(std::span(again).first(size), bytes),
                 "what was accepted encodes to the very same bytes");
}

}  // namespace

/// Checks the input as it is, and then with a correct size and checksum, because a fuzzer
/// cannot guess a checksum.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  check(bytes);
  if (size < wire::kHeaderBytes + wire::kChecksumBytes) return 0;
  std::vector<std::byte> sealed(bytes.begin(), bytes.end());
  const auto put = [&sealed](std::size_t at, std::size_t value) {
    for (std::size_t i = 0; i < 4; ++i) {
      sealed[at + i] = static_cast<std::byte>(value >> (8 * i) & 0xff);
    }
  };
  constexpr std::size_t kSizeAt = 20;
  const std::size_t end = size - wire::kChecksumBytes;
  put(kSizeAt, size);
  put(end, device::crc32(std::span(sealed).first(end)));
  check(sealed);
  return 0;
}
