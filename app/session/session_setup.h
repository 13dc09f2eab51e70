#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/profile/known_profile.h"
#include "core/storage/study_store.h"
#include "experiments/order/cell.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What every session of a run has in common.
struct SessionSetup {
  const experiments::Study& study;
  /// Where its participants, or at least their hands, are simulated; nullptr: persons.
  const experiments::Laboratory* laboratory = nullptr;
  std::filesystem::path study_file;
  std::string device = "lumped";
  const KnownProfile* profile = nullptr;  ///< What was measured of it; nullptr: nothing.
  std::uint64_t seed = 1;  ///< Of the study; each session's own is derived from it.
  bool pilot = false;
  bool realtime = false;
  bool allow_no_realtime = false;  ///< A real device also without real-time rights; kept.
  bool record = true;              ///< Samples, besides the summaries of strokes.
  /// What every participant of it brings; none: what each brings is drawn.
  experiments::FieldValues fields{};
};

/// The shipped laboratory whose simulated hands fit the device: "thesis", or
/// "thesis_exoskeleton" with an arm that is strong enough for the whole robot.
[[nodiscard]] std::string default_laboratory(std::string_view device);

/// Adds the rows of sessions for these participants, cells assigned in the order given, before
/// any of them starts: so what a session holds does not depend on how many run at once. Returns
/// their numbers. Throws `Error` if one of the participants has a session already.
[[nodiscard]] std::vector<std::int64_t> add_sessions(
    core::StudyStore& store, const SessionSetup& setup,
    const std::vector<std::string>& participants);

/// A real device was allowed without real-time rights when the session was begun.
[[nodiscard]] bool may_lack_rights(const core::SessionRow& session);

}  // namespace jnd::app
