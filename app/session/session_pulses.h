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

/// The pulses by which a session tells another recorder what happens
/// (docs/how-to/send_markers.md), on a thread of their own. If the port fails, an event tells
/// so, and the session goes on. Used by the session's thread. Not real time.
class SessionPulses {
 public:
  struct Parameters {
    WantedMarkers wanted;
    core::MarkerCodes codes;  ///< The codes of the study.
    /// Opens the port on the pulses' thread; tests open another kind.
    std::function<std::unique_ptr<core::MarkerPort>(const WantedMarkers&)> open =
        core::open_marker_port;
  };

  /// Never throws for a port that cannot be opened.
  explicit SessionPulses(const Parameters& parameters);

  /// Sends the pulse of a committed event, if it has one.
  void tell(const core::EventRow& event);
  /// Commits what there is to tell: that the port was opened or has failed, and the times of
  /// pulses. Waits for the disk, so call it while nothing is felt.
  void follow(experiments::Session& session);
  /// Sends the pulse of the end, waits a moment for it, and commits the outcome of all pulses.
  /// Call it once, before the session's last event.
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
