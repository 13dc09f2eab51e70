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

/// Runs a session on a thread of its own, so that a slow disk delays neither the window nor its
/// heartbeat. Requests go in, pictures come out. It owns everything that the session needs.
class SessionWorker {
 public:
  struct Parameters {
    std::unique_ptr<core::StudyStore> store;  ///< Open for writing.
    std::int64_t session = 0;                 ///< The store already has the session's row.
    experiments::Study study;
    /// The laboratory of a simulated hand; otherwise empty.
    std::unique_ptr<experiments::Laboratory> laboratory;
    std::string language;
    std::map<std::string, std::string> fitting{};  ///< As in `OperatedSession::Parameters`.
    bool allow_no_realtime = false;
    std::filesystem::path stops;  ///< As in `OperatedSession::Parameters`.
    WantedStreams streams{};      ///< As in `OperatedSession::Parameters`.
    SoundChoice sound{};          ///< As in `OperatedSession::Parameters`.
    WantedMarkers markers{};      ///< As in `OperatedSession::Parameters`.
    /// As in `OperatedSession::Parameters`.
    std::map<std::string, std::string> controls{};
    /// As `WindowRequest::simulated_clock_s`; the session's thread calls it.
    std::function<double()> simulated_clock_s{};
    /// The session's thread calls it whenever there is a newer picture; may be empty.
    std::function<void()> wake;
  };

  /// Starts the thread. `exchange` must outlive this object.
  SessionWorker(Parameters parameters, OperatorExchange& exchange);
  /// Leaves a session that is still open, so that it can be resumed.
  ~SessionWorker();
  SessionWorker(const SessionWorker&) = delete;
  SessionWorker& operator=(const SessionWorker&) = delete;

  void request(OperatorRequest request);
  /// The newest picture; nullptr until the device has started.
  [[nodiscard]] std::shared_ptr<const SessionView> view() const;
  /// True while some request was not looked at yet. If false, `view` shows what the requests
  /// led to.
  [[nodiscard]] bool is_behind() const;
  /// True while a request was looked at but has to wait for a ramp or a rest.
  [[nodiscard]] bool has_waiting_requests() const;
  [[nodiscard]] const LiveTrace& trace() const noexcept { return trace_; }
  [[nodiscard]] const ScopeTrace& scopes() const noexcept { return scopes_; }
  /// Why the session could not be opened; "" if it could.
  [[nodiscard]] std::string failure() const;
  /// True if the thread has ended, because the session was left or never started. The store is
  /// closed then.
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
