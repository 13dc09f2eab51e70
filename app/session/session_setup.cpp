#include "app/session/session_setup.h"

#include <set>

#include "app/session/stored_session.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/random_stream.h"
#include "core/storage/sha256.h"
#include "device/registry/device_registry.h"
#include "experiments/participants/abilities.h"
#include "experiments/session/plan.h"
#include "experiments/session/session.h"

namespace jnd::app {
namespace {

constexpr char kWithoutRights[] = "real-time thread, also without real-time rights";

}  // namespace

std::string default_laboratory(std::string_view device) {
  return device::kind_of(device) == "exoskeleton" ? "thesis_exoskeleton" : "thesis";
}

static std::string laboratory_text(const SessionSetup& setup) {
  return setup.laboratory == nullptr ? "" : setup.laboratory->text;
}

/// Refuses other studies: one folder is one study and, if simulated, one laboratory, because
/// pooling two would give no valid result.
static void refuse_other_study(const core::StudyStore& store, const SessionSetup& setup,
                               const std::vector<core::SessionRow>& rows) {
  const std::string problem = other_study_problem(store, setup.study);
  if (!problem.empty()) throw core::Error(problem);
  for (const core::SessionRow& row : rows) {
    if (row.laboratory == laboratory_text(setup)) continue;
    throw core::Error(store.folder().string() +
                      ": expected the laboratory that its sessions were simulated in, or "
                      "persons as in them, found another; use a new folder for it");
  }
}

std::vector<std::int64_t> add_sessions(core::StudyStore& store, const SessionSetup& setup,
                                       const std::vector<std::string>& participants) {
  std::set<std::string> known;
  const std::vector<core::SessionRow> rows = store.sessions();
  for (const core::SessionRow& row : rows) known.insert(row.participant);
  for (const core::WithdrawalRow& gone : store.withdrawals()) known.insert(gone.participant);
  for (const std::string& participant : participants) {
    if (!known.insert(participant).second) {
      throw core::Error(store.folder().string() + ": expected a new participant, found that " +
                        participant + " has a session already; choose another or resume");
    }
  }
  if (setup.laboratory != nullptr) {
    experiments::require_abilities(*setup.laboratory, setup.study);
  }
  refuse_other_study(store, setup, rows);
  std::error_code error;
  const std::string hash = store.add_protocol(
      setup.study_file.filename().string(), setup.study.text,
      std::filesystem::relative(setup.study_file, store.folder(), error).generic_string());
  const std::string profile_hash =
      setup.profile == nullptr ? "" : store.add_device_profile(setup.profile->text);
  const std::vector<experiments::Cell> cells =
      experiments::planned_cells(setup.study, experiments::completed_cells(store), setup.seed,
                                 static_cast<std::int64_t>(rows.size()),
                                 static_cast<int>(participants.size()), setup.fields);
  std::vector<std::int64_t> sessions;
  for (std::size_t i = 0; i < participants.size(); ++i) {
    core::SessionRow row;
    row.participant = participants[i];
    row.protocol_sha256 = hash;
    row.seed = experiments::session_seed(setup.seed, setup.study.name, participants[i]);
    row.cells = to_string(cells[i]);
    row.pilot = setup.pilot;
    row.simulated = setup.laboratory != nullptr;
    row.device = setup.device;
    row.device_profile_sha256 = profile_hash;
    row.laboratory = laboratory_text(setup);
    row.program_version = JND_VERSION;
    row.realtime = !setup.realtime           ? "simulated"
                   : setup.allow_no_realtime ? kWithoutRights
                                             : "real-time thread";
    row.recorded = setup.record;
    row.rate_hz = setup.study.device.rate_hz;
    // By the clock that its events have: simulated time counts from 0.
    if (setup.realtime) row.started_time_ns = core::SystemClock().now_ns();
    sessions.push_back(store.add_session(row));
  }
  return sessions;
}

bool may_lack_rights(const core::SessionRow& session) {
  return session.realtime == kWithoutRights;
}

}  // namespace jnd::app
