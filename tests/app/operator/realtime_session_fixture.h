#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "app/operator/operated_session_fixture.h"

namespace jnd::app {

/// A session in real time, with a window that is alive.
class RealtimeSessionTest : public OperatedSessionTest {
 protected:
  ~RealtimeSessionTest() override {
    session_.reset();
    window_is_open_ = false;
    if (window_.joinable()) window_.join();
  }

  /// Makes sessions that are opened from now on run in real time.
  void open_window() {
    realtime_ = true;
    window_ = std::thread([this] {
      while (window_is_open_) {
        exchange_.heartbeat.beat();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
  }

  SessionView until(const std::function<bool(const SessionView&)>& is_so) {
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < patience) {
      session_->advance(0.0);
      const SessionView now = view();
      if (is_so(now)) return now;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "that never came; step " << static_cast<int>(view().step);
    return view();
  }

  /// Presents the interval and waits until the hand strokes and feels it.
  SessionView present(std::int64_t trial, const std::string& interval) {
    session_->request(operate::Present{trial, interval});
    return until([&](const SessionView& now) {
      return now.trial && now.trial->interval == interval && now.trial->felt_s > 0.3 &&
             force_n(now.telemetry.total_force_n) > 0.5;
    });
  }

  static double force_n(const core::PlainVector& force) {
    return std::hypot(force[0], force[1], force[2]);
  }

 private:
  std::atomic<bool> window_is_open_{true};
  std::thread window_;
};

}  // namespace jnd::app
