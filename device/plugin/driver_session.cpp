#include "device/plugin/driver_session.h"

#include <algorithm>
#include <thread>

#include "core/error.h"
#include "device/plugin/futex.h"

namespace jnd::device {
namespace {

using core::Fault;

/// "found: the cable is out", in the words of the driver.
std::string found_words(const DriverLibrary& library, jnd_device* device) {
  const std::string words = text_in_sentence(library.error(device));
  if (!words.empty()) return "found: " + words;
  return "found that it failed and that jnd_device_error says nothing; have it say why";
}

void require_known(int outcome, const char* function) {
  if (outcome == JND_DEVICE_OK || outcome == JND_DEVICE_FAILED) return;
  throw core::Error(std::string(function) +
                    ": expected JND_DEVICE_OK or JND_DEVICE_FAILED, found " +
                    std::to_string(outcome) + "; return one of these");
}

jnd_device_description described(const DriverLibrary& library, jnd_device* device,
                                 const std::string& options) {
  jnd_device_description description{};
  description.struct_size = sizeof description;
  const int outcome = library.describe(device, options.c_str(), &description);
  require_known(outcome, "jnd_device_describe");
  if (outcome != JND_DEVICE_OK) {
    throw core::Error("expected the driver to describe its device, " +
                      found_words(library, device));
  }
  require_description(description);
  return description;
}

core::ForceLimiter::Parameters limits_of(const jnd_device_description& description) {
  return {.per_point_n = description.max_force_per_point_n,
          .total_n = description.max_total_force_n,
          .slew_n_per_s = description.max_slew_n_per_s,
          .max_speed_m_per_s = description.max_speed_m_per_s};
}

bool is_none(const core::PointVectors& force_n) noexcept {
  return std::all_of(force_n.begin(), force_n.end(),
                     [](const Eigen::Vector3d& force) { return force.isZero(0.0); });
}

}  // namespace

DriverSession::DriverSession(const std::filesystem::path& file, std::string options,
                             double rate_hz)
    : library_(file),
      options_(std::move(options)),
      rate_hz_(rate_hz),
      description_(described(library_, nullptr, options_)),
      limiter_(limits_of(description_), 1.0 / rate_hz) {}

void DriverSession::open() {
  close();
  jnd_device* device = nullptr;
  const int outcome = library_.open(options_.c_str(), rate_hz_, &device);
  require_known(outcome, "jnd_device_open");
  if (outcome != JND_DEVICE_OK) {
    throw core::Error("expected the driver to open its device, " +
                      found_words(library_, nullptr));
  }
  if (device == nullptr) {
    throw core::Error(
        "jnd_device_open: expected a device in *device, found a null pointer although it "
        "returned JND_DEVICE_OK; set *device before it returns");
  }
  device_ = device;
  halt_.reset();
  limiter_.rearm();
  num_writes_ = 0;
  newest_.reset();
  try {
    const jnd_device_description now = described(library_, device, options_);
    require_same_device(description_, now);
    description_ = now;
  } catch (...) {
    close();
    throw;
  }
}

void DriverSession::close() noexcept {
  jnd_device* device = device_.exchange(nullptr);
  if (device == nullptr) return;
  while (num_halting_ > 0) std::this_thread::yield();
  library_.halt(device);
  library_.close(device);
}

Fault DriverSession::read(jnd_device_state& measured) noexcept {
  jnd_device* device = device_.load(std::memory_order_relaxed);
  if (device == nullptr) return Fault::kDeviceReadFailed;
  jnd_device_state now{};
  now.struct_size = sizeof now;
  const int outcome = library_.read(device, &now);
  problem_ = nullptr;
  if (outcome == JND_DEVICE_NO_SAMPLE && newest_) {
    measured = *newest_;
    return Fault::kNone;
  }
  if (outcome == JND_DEVICE_NO_SAMPLE) {
    problem_ =
        "the first jnd_device_read found no measurement; open has to wait until there is one";
  }
  if (outcome != JND_DEVICE_OK) return Fault::kDeviceReadFailed;
  core::HapticState state;
  if (const Fault found = checked_state(description_, now, state); found != Fault::kNone) {
    problem_ = state_problem(description_, now);
    return found;
  }
  if (newest_ && now.sample_number == newest_->sample_number) {
    measured = *newest_;
    return Fault::kNone;
  }
  if (const Fault found = check_newness(now); found != Fault::kNone) return found;
  if ((description_.flags & JND_DEVICE_HAS_DEVICE_TIME) == 0) {
    now.device_time_ns = monotonic_ns();
  }
  state_ = state;
  newest_ = measured = now;
  return Fault::kNone;
}

/// A number or a time that goes back belongs to an old measurement.
Fault DriverSession::check_newness(const jnd_device_state& measured) noexcept {
  if (!newest_) return Fault::kNone;
  const bool number_rises = measured.sample_number > newest_->sample_number;
  const bool time_rises = (description_.flags & JND_DEVICE_HAS_DEVICE_TIME) == 0 ||
                          measured.device_time_ns > newest_->device_time_ns;
  return number_rises && time_rises ? Fault::kNone : Fault::kStaleSample;
}

Fault DriverSession::write(const core::PointVectors& force_on_hand_n) noexcept {
  for (const Eigen::Vector3d& force_n : force_on_hand_n) {
    if (force_n.allFinite()) continue;
    halt();
    return Fault::kNonFiniteForce;
  }
  const bool nothing_asked = is_none(force_on_hand_n);
  core::PointVectors force_n = force_on_hand_n;
  Fault found = Fault::kNone;
  if (halt_.withholds(force_on_hand_n) || nothing_asked || !newest_) {
    // A request for zero force takes effect at once, because the slew must not delay an end.
    limiter_.rearm();
    force_n = core::zero_vectors();
    if (!nothing_asked) found = newest_ ? Fault::kWatchdog : Fault::kDeviceReadFailed;
  } else {
    (void)limiter_.limit(state_.attached, state_.tip_velocity_m_per_s, force_n);
    found = limiter_.fault();
  }
  const Fault taken = pass_on(force_n);
  // If a halt came in the middle of this, a force that was passed on after it must not persist.
  if (!is_none(force_n) && halt_.is_halted()) (void)pass_on(core::zero_vectors());
  return taken != Fault::kNone ? taken : found;
}

Fault DriverSession::pass_on(const core::PointVectors& force_on_hand_n) noexcept {
  jnd_device* device = device_.load(std::memory_order_relaxed);
  if (device == nullptr) return Fault::kDeviceWriteFailed;
  jnd_device_command command{};
  command.struct_size = sizeof command;
  command.write_number = ++num_writes_;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      command.force_on_hand_n[i][axis] = force_on_hand_n[static_cast<std::size_t>(i)][axis];
    }
  }
  if (library_.write(device, &command) == JND_DEVICE_OK) return Fault::kNone;
  halt();
  problem_ = nullptr;
  return Fault::kDeviceWriteFailed;
}

void DriverSession::words_of_failure(std::array<char, 128>& words) noexcept {
  jnd_device* device = device_.load(std::memory_order_relaxed);
  const char* said = device == nullptr ? nullptr : library_.error(device);
  if (problem_ != nullptr) said = problem_;
  words.fill('\0');
  for (std::size_t i = 0; said != nullptr && i + 1 < words.size() && said[i] != '\0'; ++i) {
    words[i] = said[i];
  }
}

void DriverSession::halt() noexcept {
  halt_.halt();
  ++num_halting_;
  if (jnd_device* device = device_.load(); device != nullptr) library_.halt(device);
  --num_halting_;
}

}  // namespace jnd::device
