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

/// What all sessions of a run have in common.
struct SessionSetup {
  const experiments::Study& study;
  /// The laboratory if the participants, or at least their hands, are simulated; nullptr for
  /// persons.
  const experiments::Laboratory* laboratory = nullptr;
  std::filesystem::path study_file;
  std::string device = "lumped";
  /// What was measured of the device; nullptr if nothing was.
  const KnownProfile* profile = nullptr;
  /// The study's seed, from which each session's own seed is derived.
  std::uint64_t seed = 1;
  bool pilot = false;
  bool realtime = false;
  /// A real device may run without real-time rights; the sessions store it.
  bool allow_no_realtime = false;
  /// Samples are recorded, in addition to the summaries of strokes.
  bool record = true;
  /// The field values of every participant; if empty, each participant's values are drawn.
  experiments::FieldValues fields{};
};

/// The shipped laboratory whose simulated hands fit the device: "thesis", or
/// "thesis_exoskeleton" with an arm that is strong enough for the whole robot.
[[nodiscard]] std::string default_laboratory(std::string_view device);

/// Adds the rows of sessions for these participants, and assigns cells in the order given,
/// before any of them starts. So what a session contains does not depend on how many run at
/// once. Returns their numbers. Throws `Error` if one of the participants already has a
/// session.
[[nodiscard]] std::vector<std::int64_t> add_sessions(
    core::StudyStore& store, const SessionSetup& setup,
    const std::vector<std::string>& participants);

/// True if a real device was allowed without real-time rights when the session began.
[[nodiscard]] bool may_lack_rights(const core::SessionRow& session);

}  // namespace jnd::app
