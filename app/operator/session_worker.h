#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/operator/live_trace.h"
#include "app/operator/operator_request.h"
#include "app/operator/scope_trace.h"
#include "app/operator/session_view.h"
#include "app/session/operator_exchange.h"
#include "app/session/session_pulses.h"
#include "app/session/session_streams.h"
#include "app/sound/session_sound.h"
#include "core/storage/study_store.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

class OperatedSession;

/// A session on a thread of its own, so that a slow disk holds up neither the window nor its
/// heartbeat: requests in, pictures out. It owns everything that the session needs.
class SessionWorker {
 public:
  struct Parameters {
    std::unique_ptr<core::StudyStore> store;  ///< Open for writing.
    std::int64_t session = 0;                 ///< Its row is in the store already.
    experiments::Study study;
    std::unique_ptr<experiments::Laboratory> laboratory;  ///< Of a simulated hand; else empty.
    std::string language;
    std::map<std::string, std::string> fitting{};  ///< As `OperatedSession::Parameters`.
    bool allow_no_realtime = false;
    std::filesystem::path stops;                    ///< As `OperatedSession::Parameters`.
    WantedStreams streams{};                        ///< Likewise.
    SoundChoice sound{};                            ///< Likewise.
    WantedMarkers markers{};                        ///< Likewise.
    std::map<std::string, std::string> controls{};  ///< Likewise.
    /// As `WindowRequest::simulated_clock_s`; asked from the thread.
    std::function<double()> simulated_clock_s{};
    /// Called from the thread whenever there is a newer picture; may be empty.
    std::function<void()> wake;
  };

  /// Starts; `exchange` must outlive it.
  SessionWorker(Parameters parameters, OperatorExchange& exchange);
  /// Leaves a session that is still open; it can be resumed.
  ~SessionWorker();
  SessionWorker(const SessionWorker&) = delete;
  SessionWorker& operator=(const SessionWorker&) = delete;

  void request(OperatorRequest request);
  /// The newest picture; nullptr until the device has started.
  [[nodiscard]] std::shared_ptr<const SessionView> view() const;
  /// What is asked for has not been looked at yet; else `view` shows what it came to.
  [[nodiscard]] bool is_behind() const;
  /// It was looked at and has to wait, for a ramp or a rest.
  [[nodiscard]] bool has_waiting_requests() const;
  [[nodiscard]] const LiveTrace& trace() const noexcept { return trace_; }
  [[nodiscard]] const ScopeTrace& scopes() const noexcept { return scopes_; }
  /// Why the session could not be opened; "" if it could.
  [[nodiscard]] std::string failure() const;
  /// The thread is through: left, or never started. The store is closed then.
  [[nodiscard]] bool over() const noexcept { return over_.load(std::memory_order_acquire); }

 private:
  void run() noexcept;
  void work();
  [[nodiscard]] double simulated_now_s() const;
  void publish(const OperatedSession& session);
  std::vector<OperatorRequest> wait_for_requests();
  std::vector<OperatorRequest> taken_requests();

  Parameters parameters_;
  OperatorExchange& exchange_;
  LiveTrace trace_;
  ScopeTrace scopes_;
  mutable std::mutex mutex_;
  std::condition_variable requested_;
  std::vector<OperatorRequest> requests_;
  std::uint64_t num_requested_ = 0, num_taken_ = 0, num_shown_ = 0;
  bool requests_wait_ = false;
  std::shared_ptr<const SessionView> view_;
  std::string failure_;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace jnd::app
