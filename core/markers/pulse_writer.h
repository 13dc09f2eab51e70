#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/marker.h"
#include "core/markers/marker_port.h"

namespace jnd::core {

/// Writes pulses in a thread of its own, one after another, and keeps the time of each. It
/// reports once that a port cannot be opened or fails, and then drops and counts all later
/// pulses. The sender never waits. Not real time.
class PulseWriter {
 public:
  /// The thread calls `open`. `width_s` is as in `WantedMarkers`.
  PulseWriter(std::function<std::unique_ptr<MarkerPort>()> open, double width_s);
  /// Ends the pulse under way and drops those that still wait.
  ~PulseWriter();
  PulseWriter(const PulseWriter&) = delete;
  PulseWriter& operator=(const PulseWriter&) = delete;

  void send(std::int64_t event, int code);

  /// What has happened since the last call of `take_news`.
  struct News {
    bool is_opened = false;  ///< The port was opened.
    /// A sentence that says why the port failed; "" otherwise.
    std::string problem;
    std::vector<MarkerPulse> pulses;  ///< Pulses that were written.
  };
  [[nodiscard]] News take_news();
  /// Waits until every pulse is written or dropped, but no longer than this.
  void wait_until_sent(double patience_s);

  [[nodiscard]] std::int64_t num_sent() const;
  [[nodiscard]] std::int64_t num_dropped() const;

 private:
  void run() noexcept;
  void write_all(MarkerPort& port);
  /// Returns false if the writer ends first.
  bool rest(double until_s);

  const std::function<std::unique_ptr<MarkerPort>()> open_;
  const double width_s_;
  mutable std::mutex mutex_;
  std::condition_variable something_, nothing_;
  std::deque<std::pair<std::int64_t, int>> waiting_;  ///< Event and code.
  News news_;
  std::int64_t num_sent_ = 0, num_dropped_ = 0;
  bool is_writing_ = false, has_failed_ = false, is_ending_ = false;
  std::thread thread_;
};

}  // namespace jnd::core
