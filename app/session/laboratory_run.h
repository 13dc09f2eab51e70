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
  std::int64_t session = 0;  ///< Its row is in the store already.
  bool realtime = false;     ///< Paced by the clock; else as fast as it goes.
  std::vector<device::ScheduledFault> injected_faults = {};  ///< For tests and rehearsals.
  bool allow_no_realtime = false;  ///< A real device also without real-time rights.
  bool arm = false;                ///< A real device: somebody beside it asked for force.
  bool shadow_guards = false;      ///< Guards only count what they would have done.
  core::Durability durability = core::Durability::kEveryCommit;
  /// How an interrupted session goes on: "repeat", "restart" or "end".
  std::string choice = "repeat";
  std::string language{};  ///< That the texts are taken to be read in; "": nobody reads them.
  /// How the device was fitted, where the session begins; see `RunningSession::keep_fitting`.
  std::map<std::string, std::string> fitting{};
  WantedStreams streams{};  ///< To and of other recorders, in real time.
  WantedMarkers markers{};  ///< To another recorder by pulses, in real time.
  std::function<void(const core::EventRow&)> on_event;  ///< After its commit; may be empty.
  std::function<void(double)> on_progress;              ///< 0 to 1; may be empty.
  std::function<bool()> is_cancelled;                   ///< Ends resumably; may be empty.
};

/// What came of it.
struct LaboratoryRunResult {
  bool ended = false;        ///< False: cancelled, and can be resumed.
  bool ended_early = false;  ///< Ended before its last stage, by somebody's choice.
  std::int64_t num_ticks = 0;
  std::string realtime;  ///< "simulated", or what the real-time thread was given.
  /// What the answers of a block say against it, "BLOCK: ..."; see `Procedure::caution`. At the
  /// end, that no force acted where there should have been one.
  std::vector<std::string> cautions;
  core::GuardCounts guards;  ///< What the loop's guards have noticed.
};

/// Joins device, loop, session and storage for one session: every presentation in closed loop,
/// every event committed before the next act. Starts or resumes, whichever the log calls for.
/// Throws `Error`; what was committed stays. Not real time.
[[nodiscard]] LaboratoryRunResult run_laboratory(const LaboratoryRun& run);

}  // namespace jnd::app
