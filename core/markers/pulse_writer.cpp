#include "core/markers/pulse_writer.h"

#include <chrono>
#include <ctime>
#include <exception>

namespace jnd::core {
namespace {

/// No session has more pulses waiting while the port accepts any.
constexpr std::size_t kMostWaitingPulses = 256;

double monotonic_now_s() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

PulseWriter::PulseWriter(std::function<std::unique_ptr<MarkerPort>()> open, double width_s)
    : open_(std::move(open)), width_s_(width_s), thread_([this] { run(); }) {}

PulseWriter::~PulseWriter() {
  {
    const std::lock_guard guard(mutex_);
    is_ending_ = true;
  }
  something_.notify_all();
  thread_.join();
}

void PulseWriter::send(std::int64_t event, int code) {
  {
    const std::lock_guard guard(mutex_);
    if (has_failed_ || waiting_.size() >= kMostWaitingPulses) {
      ++num_dropped_;
      return;
    }
    waiting_.emplace_back(event, code);
  }
  something_.notify_all();
}

PulseWriter::News PulseWriter::take_news() {
  const std::lock_guard guard(mutex_);
  return std::exchange(news_, {});
}

void PulseWriter::wait_until_sent(double patience_s) {
  std::unique_lock lock(mutex_);
  nothing_.wait_for(lock, std::chrono::duration<double>(patience_s),
                    [this] { return has_failed_ || (waiting_.empty() && !is_writing_); });
}

std::int64_t PulseWriter::num_sent() const {
  const std::lock_guard guard(mutex_);
  return num_sent_;
}

std::int64_t PulseWriter::num_dropped() const {
  const std::lock_guard guard(mutex_);
  return num_dropped_;
}

void PulseWriter::run() noexcept {
  try {
    const std::unique_ptr<MarkerPort> port = open_();
    {
      const std::lock_guard guard(mutex_);
      news_.is_opened = true;
    }
    write_all(*port);
  } catch (const std::exception& error) {
    const std::lock_guard guard(mutex_);
    has_failed_ = true;
    is_writing_ = false;
    num_dropped_ += static_cast<std::int64_t>(waiting_.size());
    waiting_.clear();
    news_.problem = error.what();
  }
  nothing_.notify_all();
}

void PulseWriter::write_all(MarkerPort& port) {
  for (;;) {
    std::pair<std::int64_t, int> next;
    {
      std::unique_lock lock(mutex_);
      something_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
      if (is_ending_) return;
      next = waiting_.front();
      waiting_.pop_front();
      is_writing_ = true;
    }
    const double before_s = monotonic_now_s();
    try {
      port.set(static_cast<std::uint8_t>(next.second));
    } catch (const std::exception&) {
      const std::lock_guard guard(mutex_);
      ++num_dropped_;
      throw;
    }
    const double after_s = monotonic_now_s();
    {
      const std::lock_guard guard(mutex_);
      ++num_sent_;
      news_.pulses.push_back({.event = next.first,
                              .code = next.second,
                              .monotonic_s = before_s,
                              .uncertainty_s = after_s - before_s});
    }
    if (width_s_ > 0.0) {
      const bool goes_on = rest(after_s + width_s_);
      port.clear();
      // The pause lets a recorder see two pulses of the same code as two.
      if (!goes_on || !rest(monotonic_now_s() + width_s_)) return;
    }
    {
      const std::lock_guard guard(mutex_);
      is_writing_ = false;
    }
    nothing_.notify_all();
  }
}

bool PulseWriter::rest(double until_s) {
  std::unique_lock lock(mutex_);
  const double left_s = until_s - monotonic_now_s();
  return !something_.wait_for(lock, std::chrono::duration<double>(left_s),
                              [this] { return is_ending_; });
}

}  // namespace jnd::core
