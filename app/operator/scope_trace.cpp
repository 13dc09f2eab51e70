#include "app/operator/scope_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/require.h"
#include "core/sample_table.h"

namespace jnd::app {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
// The first column after the tick.
constexpr std::size_t kFirstColumn = 1;

}  // namespace

ScopeTrace::ScopeTrace(const Parameters& parameters)
    : parameters_(parameters), names_(core::sample_column_names({.joints = true})) {
  core::require_positive(parameters.rate_hz, "rate_hz");
  core::require_positive(parameters.duration_s, "duration_s");
  core::require_positive(parameters.intervals_per_s, "intervals_per_s");
  names_.erase(names_.begin(), names_.begin() + kFirstColumn);
  ticks_per_interval_ =
      std::max<std::int64_t>(1, std::llround(parameters.rate_hz / parameters.intervals_per_s));
  capacity_ = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(parameters.duration_s / time_s_of(1))));
  intervals_.resize(capacity_);
  extents_.resize(capacity_ * names_.size());
  current_.resize(names_.size());
}

double ScopeTrace::time_s_of(std::int64_t interval) const noexcept {
  return static_cast<double>(interval * ticks_per_interval_) / parameters_.rate_hz;
}

void ScopeTrace::take(const core::Sample& sample) {
  const std::vector<double> values = core::sample_values(sample, {.joints = true});
  const std::int64_t interval = sample.tick / ticks_per_interval_;
  const std::lock_guard guard(mutex_);
  has_joints_ = has_joints_ || core::has_joints(sample);
  if (has_current_ && interval < current_interval_) start_anew();
  if (has_current_ && interval != current_interval_) finish_interval();
  if (!has_current_) begin_interval(interval);
  for (std::size_t i = 0; i < current_.size(); ++i) {
    const auto value = static_cast<float>(values[kFirstColumn + i]);
    if (!std::isfinite(value)) continue;
    // If one argument is NaN, `fmin` and `fmax` return the other one.
    current_[i] = {std::fmin(current_[i].low, value), std::fmax(current_[i].high, value)};
  }
}

void ScopeTrace::begin_interval(std::int64_t number) {
  has_current_ = true;
  current_interval_ = number;
  std::ranges::fill(current_, Extent{kNone, kNone});
}

void ScopeTrace::finish_interval() {
  intervals_[next_] = current_interval_;
  std::ranges::copy(current_,
                    extents_.begin() + static_cast<std::ptrdiff_t>(next_ * current_.size()));
  next_ = (next_ + 1) % capacity_;
  count_ = std::min(count_ + 1, capacity_);
  has_current_ = false;
}

void ScopeTrace::start_anew() {
  next_ = count_ = 0;
  has_current_ = false;
}

void ScopeTrace::clear() {
  const std::lock_guard guard(mutex_);
  start_anew();
}

ScopePicture ScopeTrace::snapshot(const std::vector<std::string>& names) const {
  ScopePicture picture{.interval_s = time_s_of(1)};
  picture.channels.resize(names.size());
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    columns.push_back(
        static_cast<std::size_t>(std::ranges::find(names_, names[i]) - names_.begin()));
    if (columns[i] < names_.size()) picture.channels[i].reserve(capacity_);
  }
  const std::lock_guard guard(mutex_);
  picture.has_joints = has_joints_;
  if (count_ == 0) return picture;
  const std::size_t oldest = (next_ + capacity_ - count_) % capacity_;
  picture.newest_s = time_s_of(intervals_[(next_ + capacity_ - 1) % capacity_]);
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t row = (oldest + i) % capacity_;
    const double time_s = time_s_of(intervals_[row]);
    if (time_s <= picture.newest_s - parameters_.duration_s) continue;
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if (columns[j] >= names_.size()) continue;
      const Extent& extent = extents_[row * names_.size() + columns[j]];
      picture.channels[j].push_back({time_s, extent.low, extent.high});
    }
  }
  return picture;
}

}  // namespace jnd::app
