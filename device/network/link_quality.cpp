#include "device/network/link_quality.h"

#include <algorithm>

namespace jnd::device {
namespace {

constexpr std::uint32_t kFewest = 50;  ///< Datagrams to judge by.
constexpr double kSmoothing = 1.0 / 16.0;

LinkLevel level_of_missing(std::uint32_t num_missing) noexcept {
  if (num_missing <= 1) return LinkLevel::kExcellent;
  if (num_missing <= 10) return LinkLevel::kGood;
  if (num_missing <= 51) return LinkLevel::kPoor;
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

void LinkQuality::restart() noexcept {
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
  restart();
  if (!had_newest) return;
  has_newest_ = true;
  num_expected_ = 1;
  mark(newest_, true);
}

bool LinkQuality::is_marked(std::uint32_t sequence) const noexcept {
  const std::uint32_t place = sequence % kWindow;
  return (came_[place / 64] >> (place % 64) & 1) != 0;
}

void LinkQuality::mark(std::uint32_t sequence, bool came) noexcept {
  if (is_marked(sequence) == came) return;
  const std::uint32_t place = sequence % kWindow;
  came_[place / 64] ^= std::uint64_t{1} << (place % 64);
  num_came_ = came ? num_came_ + 1 : num_came_ - 1;
}

void LinkQuality::advance_to(std::uint32_t sequence) noexcept {
  const std::uint32_t ahead = sequence - newest_;
  const std::uint32_t num_lost = ahead - 1;
  counts_.lost += num_lost;
  if (num_lost >= static_cast<std::uint32_t>(parameters_.max_lost_in_a_row)) broken_ = true;
  // Whatever leaves the window makes room for what is new in it.
  for (std::uint32_t i = 1; i <= std::min(ahead, kWindow); ++i) mark(newest_ + i, false);
  num_expected_ = std::min(kWindow, num_expected_ + std::min(ahead, kWindow));
  newest_ = sequence;
}

LinkQuality::Verdict LinkQuality::received(std::uint32_t sequence) noexcept {
  // Half of all numbers count as ahead, the other half as behind: so they may wrap.
  const auto ahead = static_cast<std::int32_t>(sequence - newest_);
  Verdict verdict = Verdict::kNewest;
  if (!has_newest_) {
    has_newest_ = true;
    newest_ = sequence;
    num_expected_ = 1;
  } else if (ahead > 0) {
    advance_to(sequence);
  } else if (ahead <= -static_cast<std::int32_t>(num_expected_) || is_marked(sequence)) {
    // One from before the first that came was never missed: counted, it would hide a loss.
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
  num_good_ = level() >= LinkLevel::kGood ? std::min(num_good_ + 1, parameters_.good_for) : 0;
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
  if (num_came_ < kFewest) return LinkLevel::kUnacceptable;
  const std::uint32_t num_missing = num_expected_ - std::min(num_came_, num_expected_);
  return std::min(level_of_missing(num_missing), level_of_round_trip(round_trip_ns_));
}

}  // namespace jnd::device
