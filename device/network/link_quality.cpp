#include "device/network/link_quality.h"

#include <algorithm>
#include <cmath>

namespace jnd::device {
namespace {

constexpr double kSmoothing = 1.0 / 16.0;

/// Returns the level for this many missing datagrams of the window. The limits are given for
/// 512.
LinkLevel level_of_missing(std::uint32_t num_missing, std::uint32_t window) noexcept {
  const auto most = [window](std::uint32_t of_512) {
    return std::max(1U, of_512 * window / 512);
  };
  if (num_missing <= most(1)) return LinkLevel::kExcellent;
  if (num_missing <= most(10)) return LinkLevel::kGood;
  if (num_missing <= most(51)) return LinkLevel::kPoor;
  return LinkLevel::kUnacceptable;
}

LinkLevel level_of_round_trip(double duration_ns) noexcept {
  if (duration_ns <= 4e6) return LinkLevel::kExcellent;
  if (duration_ns <= 8e6) return LinkLevel::kGood;
  if (duration_ns <= 16e6) return LinkLevel::kPoor;
  return LinkLevel::kUnacceptable;
}

}  // namespace

std::string_view name(LinkLevel level) noexcept {
  switch (level) {
    case LinkLevel::kUnacceptable:
      return "unacceptable";
    case LinkLevel::kPoor:
      return "poor";
    case LinkLevel::kGood:
      return "good";
    case LinkLevel::kExcellent:
      return "excellent";
  }
  return "unknown";
}

void LinkQuality::restart(double rate_hz) noexcept {
  const double rate = std::clamp(rate_hz, 100.0, 16'000.0);
  const auto datagrams_of = [rate](double duration_s) {
    return static_cast<std::uint32_t>(std::max(1.0, std::round(duration_s * rate)));
  };
  window_ = datagrams_of(0.512);
  fewest_ = datagrams_of(0.050);
  most_in_a_row_ = datagrams_of(0.020);
  good_for_ = static_cast<int>(datagrams_of(0.100));
  forget();
}

void LinkQuality::forget() noexcept {
  has_newest_ = false;
  num_expected_ = 0;
  num_came_ = 0;
  came_.fill(0);
  broken_ = false;
  num_good_ = 0;
  has_round_trip_ = false;
  round_trip_ns_ = 0.0;
}

void LinkQuality::judge_anew() noexcept {
  const bool had_newest = has_newest_;
  forget();
  if (!had_newest) return;
  has_newest_ = true;
  num_expected_ = 1;
  mark(newest_, true);
}

bool LinkQuality::is_marked(std::uint32_t sequence) const noexcept {
  const std::uint32_t place = sequence % kRing;
  return (came_[place / 64] >> (place % 64) & 1) != 0;
}

void LinkQuality::mark(std::uint32_t sequence, bool came) noexcept {
  if (is_marked(sequence) == came) return;
  const std::uint32_t place = sequence % kRing;
  came_[place / 64] ^= std::uint64_t{1} << (place % 64);
  num_came_ = came ? num_came_ + 1 : num_came_ - 1;
}

void LinkQuality::advance_to(std::uint32_t sequence) noexcept {
  const std::uint32_t ahead = sequence - newest_;
  const std::uint32_t num_lost = ahead - 1;
  counts_.lost += num_lost;
  if (num_lost >= most_in_a_row_) broken_ = true;
  // Whatever leaves the window is forgotten.
  for (std::uint32_t i = 1; i <= std::min(ahead, window_); ++i) {
    mark(newest_ + i - window_, false);
  }
  num_expected_ = std::min(window_, num_expected_ + std::min(ahead, window_));
  newest_ = sequence;
}

LinkQuality::Verdict LinkQuality::received(std::uint32_t sequence) noexcept {
  // Half of all numbers count as ahead, the other half as behind, so they may wrap.
  const auto ahead = static_cast<std::int32_t>(sequence - newest_);
  Verdict verdict = Verdict::kNewest;
  if (!has_newest_) {
    has_newest_ = true;
    newest_ = sequence;
    num_expected_ = 1;
  } else if (ahead > 0) {
    advance_to(sequence);
  } else if (ahead <= -static_cast<std::int32_t>(num_expected_) || is_marked(sequence)) {
    // A datagram from before the first one that came was never missed. If it counted, it would
    // hide a loss.
    ++counts_.doubled;
    return Verdict::kRepeated;
  } else {
    verdict = Verdict::kReordered;
    ++counts_.reordered;
    --counts_.lost;
  }
  mark(sequence, true);
  ++counts_.received;
  came_in_tick_ = true;
  num_good_ = level() >= LinkLevel::kGood ? std::min(num_good_ + 1, good_for_) : 0;
  return verdict;
}

void LinkQuality::echoed(std::int64_t echo_ns, std::int64_t now_ns) noexcept {
  if (!(echo_ns > last_echo_ns_ && echo_ns <= now_ns)) return;
  last_echo_ns_ = echo_ns;
  const auto newest_ns = static_cast<double>(now_ns - echo_ns);
  round_trip_ns_ =
      has_round_trip_ ? round_trip_ns_ + kSmoothing * (newest_ns - round_trip_ns_) : newest_ns;
  has_round_trip_ = true;
}

void LinkQuality::end_tick() noexcept {
  if (!came_in_tick_) ++counts_.late;
  came_in_tick_ = false;
}

LinkLevel LinkQuality::level() const noexcept {
  if (num_came_ < fewest_) return LinkLevel::kUnacceptable;
  const std::uint32_t num_missing = num_expected_ - std::min(num_came_, num_expected_);
  return std::min(level_of_missing(num_missing, window_), level_of_round_trip(round_trip_ns_));
}

}  // namespace jnd::device
