#include "app/session/session_setup.h"

#include <atomic>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>

#include "app/command_line/command.h"
#include "app/session/laboratory_run.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/random_stream.h"
#include "core/storage/sha256.h"
#include "device/registry/device_registry.h"
#include "experiments/order/counterbalance.h"
#include "experiments/participants/abilities.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"
#include "experiments/session/session.h"

namespace jnd::app {
namespace {

constexpr char kWithoutRights[] = "real-time thread, also without real-time rights";

}  // namespace

std::string default_laboratory(std::string_view device) {
  return device::kind_of(device) == "exoskeleton" ? "thesis_exoskeleton" : "thesis";
}

void require_device(const std::string& name) {
  try {
    (void)device::device_named(name);
  } catch (const core::Error& error) {
    throw UsageError(std::string("--device: ") + error.what());
  }
}

constexpr double kUsualRateHz = 1000.0;

void require_device_moves_by_itself(const std::string& name, const std::string& place) {
  if (device::make_device(name, kUsualRateHz)->capabilities().moves_by_itself) return;
  throw UsageError(place +
                   ": expected a device that moves by itself, for participants that are "
                   "simulated, found one that a person has to move; choose another, see `jnd "
                   "devices`");
}

bool has_own_clock(const std::string& device) {
  return device::make_device(device, kUsualRateHz)->capabilities().has_own_clock;
}

void require_device_keeps_pace(const std::string& name, const std::string& place) {
  if (!has_own_clock(name)) return;
  throw UsageError(place +
                   ": expected a device that is simulated here, as fast as it goes, found one "
                   "with a clock of its own; run single sessions on it with `jnd run "
                   "--headless`");
}

void require_device_starts(const std::string& name, double rate_hz) {
  try {
    const std::unique_ptr<device::HapticDevice> device = device::make_device(name, rate_hz);
    // The motors of a real one turn on only after the check for real time, in `start_haptics`.
    if (!device->capabilities().simulated) return;
    device->open();
    device->close();
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
}

static std::string laboratory_text(const SessionSetup& setup) {
  return setup.laboratory == nullptr ? "" : setup.laboratory->text;
}

std::string other_study_problem(const core::StudyStore& store,
                                const experiments::Study& study) {
  const std::string hash = core::sha256(study.text);
  for (const core::SessionRow& row : store.sessions()) {
    if (row.protocol_sha256 == hash) continue;
    return store.folder().string() + ": expected the study file that it was begun with (" +
           row.protocol_sha256.substr(0, 12) + "), found another or a changed one (" +
           hash.substr(0, 12) + "); use a new folder for it";
  }
  return "";
}

/// One folder is one study and, simulated, one laboratory: pooling two would be no result at
/// all.
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
    row.laboratory = laboratory_text(setup);
    row.program_version = JND_VERSION;
    row.realtime = !setup.realtime           ? "simulated"
                   : setup.allow_no_realtime ? kWithoutRights
                                             : "real-time thread";
    row.recorded = setup.record;
    row.rate_hz = setup.study.device.rate_hz;
    sessions.push_back(store.add_session(row));
  }
  return sessions;
}

bool may_lack_rights(const core::SessionRow& session) {
  return session.realtime == kWithoutRights;
}

std::vector<std::string> next_participants(const core::StudyStore& store, int count) {
  std::set<std::string> taken;
  for (const core::SessionRow& row : store.sessions()) taken.insert(row.participant);
  for (const core::WithdrawalRow& gone : store.withdrawals()) taken.insert(gone.participant);
  return next_participants(taken, count);
}

std::vector<std::string> next_participants(const std::set<std::string>& taken, int count) {
  std::vector<std::string> names;
  for (int number = 1; static_cast<int>(names.size()) < count; ++number) {
    char name[16];
    std::snprintf(name, sizeof name, "P%02d", number);
    if (!taken.contains(name)) names.emplace_back(name);
  }
  return names;
}

experiments::Study stored_study(const core::StudyStore& store, std::int64_t session) {
  const core::SessionRow row = store.session(session);
  return experiments::read_stored_study(store.protocol(row.protocol_sha256).text,
                                        store.folder().string() + ": stored protocol");
}

std::vector<const experiments::Stage*> stages_of_session(const experiments::Study& study,
                                                         const std::string& cells) {
  std::vector<const experiments::Stage*> stages;
  for (const experiments::StageInstance& instance :
       experiments::stages_of(study, experiments::cell_from_text(study, cells))) {
    stages.push_back(instance.stage);
  }
  return stages;
}

std::string changed_study_remark(const core::StudyStore& store,
                                 const core::SessionRow& session) {
  const core::ProtocolRow protocol = store.protocol(session.protocol_sha256);
  if (protocol.relative_path.empty()) return "";
  const std::filesystem::path file = store.folder() / protocol.relative_path;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return "";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return "";
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string hash = core::sha256(text);
  if (hash == protocol.sha256) return "";
  return file.lexically_normal().string() + ": expected the text that session " +
         std::to_string(session.session) + " was begun with (" + protocol.sha256.substr(0, 12) +
         "), found a changed one (" + hash.substr(0, 12) +
         "); the session goes on with the text it was begun with";
}

void require_unblinded(const core::StudyStore& store) {
  std::set<std::string> seen;
  for (const core::SessionRow& row : store.sessions()) {
    if (!seen.insert(row.protocol_sha256).second) continue;
    if (stored_study(store, row.session).blinding != experiments::Blinding::kDouble) continue;
    if (store.unblinded()) return;
    throw core::Error(store.folder().string() +
                      ": expected a study whose levels may be seen, found a double-blind one "
                      "that nobody has unblinded; `jnd unblind` does, and leaves a record");
  }
}

std::int64_t run_batch(const Batch& batch) {
  std::vector<std::atomic<double>> progress(batch.sessions.size());
  std::atomic<std::int64_t> num_ticks{0};
  const auto report = [&] {
    if (!batch.on_progress) return;
    double sum = 0.0;
    for (const std::atomic<double>& one : progress) sum += one.load(std::memory_order_relaxed);
    batch.on_progress(sum / static_cast<double>(progress.size()));
  };
  core::for_each_index(batch.sessions.size(), batch.jobs, [&](std::size_t i) {
    if (batch.is_cancelled && batch.is_cancelled()) return;
    const LaboratoryRunResult result =
        run_laboratory({.study = batch.study,
                        .laboratory = batch.laboratory,
                        .store = batch.store,
                        .session = batch.sessions[i],
                        .durability = core::Durability::kAtClose,
                        .on_progress =
                            [&, i](double done) {
                              progress[i].store(done, std::memory_order_relaxed);
                              report();
                            },
                        .is_cancelled = batch.is_cancelled});
    progress[i].store(1.0);
    num_ticks += result.num_ticks;
  });
  return num_ticks;
}

}  // namespace jnd::app
