#include "device/plugin/plugin_device.h"

#include <algorithm>
#include <cmath>

#include "device/plugin/driver_library.h"
#include "device/plugin/futex.h"

namespace jnd::device {
namespace {

using core::Fault;

/// Share of a tick. The rest is for the loop and the write.
constexpr double kWaitRatio = 0.4;
/// A simulation may be waited for this long, because its time stands still meanwhile. This is
/// within the watchdog's 0.25 s.
constexpr std::int64_t kWaitForSimulation_ns = 200'000'000;
/// This is longer because nobody can be hurt and a busy machine may hold the driver's process
/// up. A simulation across the network has the same value.
constexpr double kMaxStaleOfSimulation_s = 0.1;
/// Of the last 256 answers, at most this many may have nothing new: a tenth.
constexpr int kMostMissing = 25;

std::int64_t in_ns(double duration_s) noexcept { return std::llround(1e9 * duration_s); }

}  // namespace

PluginDevice::PluginDevice(const Parameters& parameters)
    : parameters_(parameters), process_(parameters.process) {
  core::require_positive(parameters.max_stale_s, "max_stale_s");
  description_ = process_.describe();
  has_own_clock_ = capabilities().has_own_clock;
  paces_loop_ = capabilities().paces_loop;
  require_rate(description_, parameters.process.rate_hz, parameters.process.place);
}

DeviceCapabilities PluginDevice::capabilities() const noexcept {
  DeviceCapabilities can = capabilities_of(description_, parameters_.process.rate_hz,
                                           parameters_.believes_simulated);
  can.max_stale_s = can.simulated ? kMaxStaleOfSimulation_s : parameters_.max_stale_s;
  return can;
}

void PluginDevice::open() {
  close();
  const jnd_device_description now = process_.open(capabilities().simulated);
  is_open_ = true;
  try {
    require_same_device(description_, now);
  } catch (const core::Error& error) {
    close();
    throw DeviceUnreachable(parameters_.process.place + ": " + error.what());
  }
  description_ = now;
}

void PluginDevice::close() noexcept {
  process_.end();
  is_open_ = is_lost_ = is_well_ = false;
  fault_ = write_fault_ = Fault::kNone;
  request_ = {};
  taken_number_ = newest_sample_ = 0;
  newest_ns_ = 0;
  counts_ = {};
  missing_.reset();
  next_judged_ = 0;
  num_missing_ = 0;
}

bool PluginDevice::wait_for_sample(std::int64_t deadline_ns) noexcept {
  if (!is_open_ || !paces_loop_) return false;
  while (true) {
    const std::uint32_t seen = process_.answer_version();
    DriverAnswer answer;
    if (process_.answer(answer) && answer.read_number > taken_number_) return true;
    if (monotonic_ns() >= deadline_ns) return false;
    process_.wait_for_answer(seen, deadline_ns);
  }
}

bool PluginDevice::read(core::HapticState& state) noexcept {
  if (!is_open_) return fail(Fault::kDeviceReadFailed);
  const std::int64_t now_ns = monotonic_ns();
  if (paces_loop_) {
    // The driver measures by itself, and what it had measured before does not count.
    request_.read_number = taken_number_ + 1;
  } else {
    ++request_.read_number;
    process_.request(request_, true);
  }
  ++counts_.num_reads;
  const std::int64_t patience_ns =
      !has_own_clock_ ? kWaitForSimulation_ns : in_ns(kWaitRatio / parameters_.process.rate_hz);
  DriverAnswer answer;
  is_well_ = false;
  // A driver whose last answer was missing is not waited for, because the loop needs its time.
  if (!receive(is_lost_ ? now_ns : now_ns + patience_ns, answer)) {
    is_lost_ = true;
    ++counts_.num_late;
    return stand_in(state, now_ns);
  }
  is_lost_ = !paces_loop_ && answer.read_number != request_.read_number;
  if (!take(answer)) return false;
  state = newest_;
  is_well_ = !is_lost_ && write_fault_ == Fault::kNone && num_missing_ <= kMostMissing;
  return true;
}

/// Waits for the answer to this read. If it does not come in time, a late answer to an earlier
/// read serves. For a simulation only the exact answer counts, because its answers cannot be
/// late.
bool PluginDevice::receive(std::int64_t deadline_ns, DriverAnswer& answer) noexcept {
  while (true) {
    const std::uint32_t seen = process_.answer_version();
    const bool is_there = process_.answer(answer);
    if (is_there && (answer.read_number == request_.read_number ||
                     (paces_loop_ && answer.read_number > taken_number_))) {
      return true;
    }
    if (monotonic_ns() >= deadline_ns) {
      return is_there && has_own_clock_ && !paces_loop_ && answer.read_number > taken_number_ &&
             answer.read_number < request_.read_number;
    }
    process_.wait_for_answer(seen, deadline_ns);
  }
}

/// This checks everything again, whatever the other side has checked, because its memory may be
/// corrupt.
bool PluginDevice::take(const DriverAnswer& answer) noexcept {
  taken_number_ = answer.read_number;
  const Fault told = answer.fault <= static_cast<std::uint32_t>(core::kLastFault)
                         ? static_cast<Fault>(answer.fault)
                         : Fault::kDeviceReadFailed;
  if (answer.is_measured != 1) {
    return fail(told != Fault::kNone ? told : Fault::kDeviceReadFailed);
  }
  write_fault_ = told;
  const jnd_device_state& measured = answer.measured;
  core::HapticState state;
  if (const Fault found = checked_state(description_, measured, state); found != Fault::kNone) {
    return fail(found);
  }
  const bool is_new = newest_ns_ == 0 || measured.sample_number != newest_sample_;
  count_newness(is_new);
  if (is_new) {
    newest_ = state;
    newest_sample_ = measured.sample_number;
    newest_ns_ = newest_.arrived_ns = monotonic_ns();
  }
  if (num_missing_ > kMostMissing) return fail(Fault::kStaleSample);
  fault_ = Fault::kNone;
  return true;
}

/// The loop excuses a reused measurement for 5 ms. A device at half the rate always reuses one,
/// and would never be detected.
void PluginDevice::count_newness(bool is_new) noexcept {
  counts_.num_repeated += is_new ? 0 : 1;
  num_missing_ += (is_new ? 0 : 1) - (missing_[next_judged_] ? 1 : 0);
  missing_[next_judged_] = !is_new;
  next_judged_ = (next_judged_ + 1) % kNumJudged;
}

bool PluginDevice::stand_in(core::HapticState& state, std::int64_t now_ns) noexcept {
  // The two additional ticks let the loop's own check of the device's time come first.
  const double longest_s = capabilities().max_stale_s + 2.0 / parameters_.process.rate_hz;
  if (newest_ns_ == 0 || !has_own_clock_ || now_ns - newest_ns_ > in_ns(longest_s)) {
    return fail(Fault::kDeviceReadFailed);
  }
  state = newest_;
  return true;
}

/// Why no answers come any more; "" if they do.
std::string PluginDevice::words_of_silence() const {
  if (std::string ended = process_.words_of_end(); !ended.empty()) return ended;
  constexpr std::uint64_t kMostUnanswered = 3;
  const std::uint64_t unanswered = process_.num_unanswered();
  if (unanswered <= kMostUnanswered) return "";
  return "its process has not answered the last " + std::to_string(unanswered) + " reads";
}

std::string PluginDevice::words_of_fault() const {
  if (std::string silent = words_of_silence(); !silent.empty()) return silent;
  DriverAnswer answer;
  if (!process_.answer(answer)) return "";
  answer.words.back() = '\0';
  return text_in_sentence(answer.words.data());
}

bool PluginDevice::fail(Fault fault) noexcept {
  fault_ = fault;
  is_well_ = false;
  return false;
}

bool PluginDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  if (!is_open_) return fail(Fault::kDeviceWriteFailed);
  for (std::size_t i = 0; i < force_on_hand_n.size(); ++i) {
    // The driver keeps the force before, and the loop halts it.
    if (!force_on_hand_n[i].allFinite()) return fail(Fault::kNonFiniteForce);
    for (int axis = 0; axis < 3; ++axis) {
      request_.force_on_hand_n[i][static_cast<std::size_t>(axis)] = force_on_hand_n[i][axis];
    }
  }
  ++request_.write_number;
  request_.written_ns = monotonic_ns();
  // The time of a simulation advances by writes alone. It may do so at the next read as well,
  // so the process need not be woken.
  process_.request(request_, has_own_clock_);
  if (write_fault_ != Fault::kNone) return fail(write_fault_);
  return fault_ == Fault::kNone;
}

}  // namespace jnd::device
