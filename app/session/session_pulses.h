#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/marker.h"
#include "core/markers/marker_port.h"
#include "core/markers/pulse_writer.h"
#include "core/storage/study_rows.h"
#include "experiments/session/session.h"

namespace jnd::app {

using core::WantedMarkers;

/// The pulses by which one session tells another recorder what happens
/// (docs/how-to/send_markers.md), on a thread of their own. A port that fails is told as an
/// event, and the session goes on. Used by the session's thread. Not real time.
class SessionPulses {
 public:
  struct Parameters {
    WantedMarkers wanted;
    core::MarkerCodes codes;  ///< Of the study.
    /// Opens the port, on the thread; of another kind in tests.
    std::function<std::unique_ptr<core::MarkerPort>(const WantedMarkers&)> open =
        core::open_marker_port;
  };

  /// Never throws for a port that cannot be opened.
  explicit SessionPulses(const Parameters& parameters);

  /// An event that was committed: its pulse, if it has any.
  void tell(const core::EventRow& event);
  /// Commits what there is to say: opened, failed, the times of pulses. Waits for the disk, so
  /// while nothing is felt.
  void follow(experiments::Session& session);
  /// Sends the pulse of the end, waits a moment for it, and commits what became of all. Once,
  /// before the session's last event.
  void close(experiments::Session& session);
  /// Why there are no pulses any more; "" as long as there are.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  void send(std::int64_t event, core::MarkerKind kind);

  Parameters parameters_;
  std::string problem_;
  bool is_closed_ = false;
  core::PulseWriter writer_;
};

}  // namespace jnd::app
