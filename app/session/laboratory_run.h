#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session_pulses.h"
#include "app/session/session_streams.h"
#include "core/safety/guard.h"
#include "core/storage/study_store.h"
#include "device/fault_injection.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// One session to be run with a simulated participant.
struct LaboratoryRun {
  const experiments::Study& study;
  const experiments::Laboratory& laboratory;
  core::StudyStore& store;
  std::int64_t session = 0;  ///< The store already has the session's row.
  bool realtime = false;     ///< The clock paces it; otherwise it runs as fast as possible.
  /// Faults for tests and rehearsals.
  std::vector<device::ScheduledFault> injected_faults = {};
  /// A real device may run without real-time rights.
  bool allow_no_realtime = false;
  /// Somebody beside a real device has asked for force.
  bool arm = false;
  /// See `Apparatus::Parameters`.
  std::function<void()> before_arming = {};
  /// Guards only count what they would have done.
  bool shadow_guards = false;
  core::Durability durability = core::Durability::kEveryCommit;
  /// How an interrupted session goes on: "repeat", "restart" or "end".
  std::string choice = "repeat";
  /// The language in which the texts are taken to be read; "" if nobody reads them.
  std::string language{};
  /// How the device was fitted when the session begins; see `RunningSession::keep_fitting`.
  std::map<std::string, std::string> fitting{};
  WantedStreams streams{};  ///< Streams to and from other recorders, in real time.
  WantedMarkers markers{};  ///< Pulses to another recorder, in real time.
  /// Called after the event's commit; may be empty.
  std::function<void(const core::EventRow&)> on_event;
  std::function<void(double)> on_progress;  ///< Called with 0 to 1; may be empty.
  /// If it returns true, the session ends and can be resumed; may be empty.
  std::function<bool()> is_cancelled;
};

/// The result of such a run.
struct LaboratoryRunResult {
  /// False if it was cancelled and can be resumed.
  bool ended = false;
  /// Somebody chose to end it before its last stage.
  bool ended_early = false;
  std::int64_t num_ticks = 0;
  std::string realtime;  ///< "simulated", or what the real-time thread was given.
  /// What the answers of a block say against it, "BLOCK: ..."; see `Procedure::caution`. At the
  /// end, that no force acted where there should have been one.
  std::vector<std::string> cautions;
  core::GuardCounts guards;  ///< What the loop's guards have noticed.
};

/// Joins device, loop, session and storage for one session. Every presentation runs in closed
/// loop, and every event is committed before the next act. Starts or resumes the session,
/// whichever its log requires. Throws `Error`; what was committed stays. Not real time.
[[nodiscard]] LaboratoryRunResult run_laboratory(const LaboratoryRun& run);

}  // namespace jnd::app
