#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

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

/// Throws `UsageError` if no device has this name.
void require_device(const std::string& name);

/// Simulated participants have no hand of their own: throws `UsageError` "PLACE: expected a
/// device that moves by itself, ..." for a device that a person has to move. `place` says where
/// the name is from, "--device mouse".
void require_device_moves_by_itself(const std::string& name, const std::string& place);

/// Whether a session on it runs in real time whatever was asked for.
[[nodiscard]] bool has_own_clock(const std::string& device);

/// For many sessions as fast as they go: throws `UsageError` for a device with a clock of its
/// own. `place` says where the name is from, "--device mouse".
void require_device_keeps_pace(const std::string& name, const std::string& place);

/// Opens a simulated device once and closes it, so that nothing is stored for a session that
/// cannot begin; a real one is left alone, for its motors may turn on. Throws
/// `EnvironmentError` with what the device says.
void require_device_starts(const std::string& name, double rate_hz);

/// A sentence if the folder has sessions of another text of this study, so that no session of
/// this one can be added; "" otherwise.
[[nodiscard]] std::string other_study_problem(const core::StudyStore& store,
                                              const experiments::Study& study);

/// Adds the rows of sessions for these participants, cells assigned in the order given, before
/// any of them starts: so what a session holds does not depend on how many run at once. Returns
/// their numbers. Throws `Error` if one of the participants has a session already.
[[nodiscard]] std::vector<std::int64_t> add_sessions(
    core::StudyStore& store, const SessionSetup& setup,
    const std::vector<std::string>& participants);

/// A real device was allowed without real-time rights when the session was begun.
[[nodiscard]] bool may_lack_rights(const core::SessionRow& session);

/// "P01", "P02", ...: the next free pseudonyms of a study.
[[nodiscard]] std::vector<std::string> next_participants(const core::StudyStore& store,
                                                         int count);
/// The same where these pseudonyms are taken.
[[nodiscard]] std::vector<std::string> next_participants(const std::set<std::string>& taken,
                                                         int count);

/// The study as it was when the session began, from the store; its text may have changed since.
[[nodiscard]] experiments::Study stored_study(const core::StudyStore& store,
                                              std::int64_t session);

/// The stages of a session with these cells, counterbalance resolved. They point into `study`.
[[nodiscard]] std::vector<const experiments::Stage*> stages_of_session(
    const experiments::Study& study, const std::string& cells);

/// A sentence if the study file that a session was begun with holds another text by now; ""
/// otherwise. The session goes on with the text it was begun with.
[[nodiscard]] std::string changed_study_remark(const core::StudyStore& store,
                                               const core::SessionRow& session);

/// Throws `Error` if a session's study is double-blind and nobody has unblinded the folder.
void require_unblinded(const core::StudyStore& store);

/// Runs sessions that were added, up to `jobs` at once, with progress on the terminal.
struct Batch {
  const experiments::Study& study;
  const experiments::Laboratory& laboratory;
  core::StudyStore& store;
  std::vector<std::int64_t> sessions;
  int jobs = 1;
  std::function<void(double)> on_progress;  ///< 0 to 1, from several threads; may be empty.
  std::function<bool()> is_cancelled;       ///< Leaves sessions open; may be empty.
};
/// Throws the first error of any session, after the others have come to an end. Returns the
/// simulated ticks of all.
std::int64_t run_batch(const Batch& batch);

}  // namespace jnd::app
