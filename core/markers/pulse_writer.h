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

/// Writes pulses from a thread of its own, one after the other, and keeps the time of each. A
/// port that cannot be opened, or fails, is told once; what is sent afterwards is dropped and
/// counted. Whoever sends waits for nobody. Not real time.
class PulseWriter {
 public:
  /// `open` is called by the thread. `width_s`: as `WantedMarkers`.
  PulseWriter(std::function<std::unique_ptr<MarkerPort>()> open, double width_s);
  /// Ends the pulse under way; what still waits is dropped.
  ~PulseWriter();
  PulseWriter(const PulseWriter&) = delete;
  PulseWriter& operator=(const PulseWriter&) = delete;

  void send(std::int64_t event, int code);

  /// What there is to tell since the last time.
  struct News {
    bool is_opened = false;           ///< The port has been opened meanwhile.
    std::string problem;              ///< It failed meanwhile: a sentence; "" otherwise.
    std::vector<MarkerPulse> pulses;  ///< That were written meanwhile.
  };
  [[nodiscard]] News take_news();
  /// Waits until everything was written or dropped, for this long at most.
  void wait_until_sent(double patience_s);

  [[nodiscard]] std::int64_t num_sent() const;
  [[nodiscard]] std::int64_t num_dropped() const;

 private:
  void run() noexcept;
  void write_all(MarkerPort& port);
  /// False where the writer ends before.
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
