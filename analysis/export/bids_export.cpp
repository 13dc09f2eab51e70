#include "analysis/export/bids_export.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "analysis/export/bids_blocks.h"
#include "analysis/export/bids_dataset.h"
#include "analysis/export/bids_motion.h"
#include "analysis/export/bids_sourcedata.h"
#include "analysis/export/bids_text.h"
#include "analysis/export/csv_table_writer.h"
#include "analysis/export/exported_profiles.h"
#include "analysis/export/exported_recording.h"
#include "analysis/export/study_tables.h"
#include "analysis/export/unfinished_folder.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

BidsDataset dataset_of(const core::StudyStore& store, const ExportOptions& options) {
  StoredStudies studies(store);
  BidsDataset dataset{.sessions = exported_sessions(store, options),
                      .recordings = options.recordings,
                      .program_version = options.program_version};
  if (dataset.sessions.empty()) {
    throw core::Error(store.folder().string() + ": expected a session to export, found none" +
                      (store.sessions().empty() ? "" : " but pilots; --pilot exports them"));
  }
  std::vector<std::string> participants;
  std::set<std::string> hashes;
  for (const core::SessionRow& row : dataset.sessions) {
    participants.push_back(row.participant);
    dataset.simulated |= row.simulated;
    if (hashes.insert(row.protocol_sha256).second) {
      dataset.protocols.push_back(store.protocol(row.protocol_sha256));
      dataset.studies.push_back(studies.study(row.protocol_sha256));
    }
  }
  dataset.subjects = bids_labels(participants);
  return dataset;
}

class BidsExport {
 public:
  BidsExport(const core::StudyStore& store, const UnfinishedFolder& folder,
             const ExportOptions& options)
      : store_(store),
        folder_(folder),
        options_(options),
        dataset_(dataset_of(store, options)),
        factors_(store, dataset_.sessions, trial_columns()) {}

  ExportOutcome run(const std::string& results_json) {
    for (const core::SessionRow& session : dataset_.sessions) {
      sessions_.push_back(
          {session, bids_blocks(store_, session, stage_names(session), options_.selection)});
    }
    label_tasks();
    write_bids_participants(folder_.path(), dataset_, store_);
    std::map<std::string, std::vector<std::pair<std::string, core::SessionRow>>> visits;
    std::size_t num_done = 0;
    for (const auto& [session, blocks] : sessions_) {
      core::tell(options_.on_progress, num_done++, sessions_.size());
      char number[32];
      auto& its = visits[session.participant];
      std::snprintf(number, sizeof number, "ses-%02d", static_cast<int>(its.size()) + 1);
      its.emplace_back(number, session);
      write_session_folder(session, blocks, number);
    }
    for (const auto& [participant, its] : visits) {
      const std::string subject = "sub-" + dataset_.subjects.at(participant);
      write_bids_sessions(folder_.path() / subject, subject, its, store_);
    }
    write_sourcedata();
    write_bids_derivatives(folder_.path(), dataset_, results_json);
    write_bids_descriptions(folder_.path(), dataset_, last_time_ns());
    return {.problems = dataset_.problems, .samples = dataset_.motion};
  }

 private:
  struct Session {
    core::SessionRow row;
    std::vector<BidsBlock> blocks;
  };

  [[nodiscard]] std::vector<std::string> stage_names(const core::SessionRow& session) const {
    return options_.stage_names ? options_.stage_names(session) : std::vector<std::string>();
  }

  void label_tasks() {
    std::vector<std::string> names;
    for (const auto& [session, blocks] : sessions_) {
      for (const BidsBlock& block : blocks) names.push_back(block.name);
    }
    tasks_ = bids_labels(std::move(names));
  }

  [[nodiscard]] std::optional<std::int64_t> last_time_ns() const {
    std::optional<std::int64_t> last;
    const std::vector<core::SessionOverview> overview = store_.overview();
    for (const core::SessionRow& session : dataset_.sessions) {
      if (session.simulated) continue;
      for (const core::SessionOverview& one : overview) {
        if (one.session == session.session && one.last_time_ns) {
          last = std::max(last.value_or(0), *one.last_time_ns);
        }
      }
    }
    return last;
  }

  void write_session_folder(const core::SessionRow& session,
                            const std::vector<BidsBlock>& blocks, const std::string& visit) {
    const std::string subject = "sub-" + dataset_.subjects.at(session.participant);
    const fs::path place = fs::path(subject) / visit;
    const std::string front = subject + "_" + visit;
    const fs::path folder = folder_.make(place);
    std::optional<ExportedRecording> recording;
    if (options_.recordings) recording.emplace(store_, session, options_);
    if (recording && !recording->problem().empty()) {
      dataset_.problems.push_back(recording->problem());
    }
    CsvTableWriter scans(folder / (front + "_scans.tsv"),
                         std::vector<std::string>{"filename", "acq_time"}, TableStyle::kBids);
    for (const BidsBlock& block : blocks) {
      if (options_.keep_going) options_.keep_going();
      const BidsTask task{.front = front + "_task-" + tasks_.at(block.name),
                          .task_name = block.name,
                          .description = description_of(block, session)};
      // A simulated session counts its time from 0, which is not a date.
      const std::string time = session.simulated ? "" : iso_time(block.time_ns);
      for (const std::string& file : write_block(place, task, block, session, recording)) {
        scans.cell(file).cell(time).end_row();
      }
    }
    scans.finish();
  }

  [[nodiscard]] static std::string description_of(const BidsBlock& block,
                                                  const core::SessionRow& session) {
    const std::string what =
        block.trials.empty()
            ? "media explored outside of trials"
            : block.trials.front().row.procedure + " in " + block.trials.front().row.medium;
    return what + (session.simulated ? ", SIMULATED" : "");
  }

  /// Returns the files for the list of scans, relative to the session's folder.
  std::vector<std::string> write_block(const fs::path& place, const BidsTask& task,
                                       const BidsBlock& block, const core::SessionRow& session,
                                       const std::optional<ExportedRecording>& recording) {
    std::vector<std::string> files;
    (block.trials.empty() ? dataset_.explored : dataset_.trials) = true;
    if (!block.trials.empty()) {
      write_bids_beh(folder_.make(place / "beh"), task, block, session, factors_);
      files.push_back("beh/" + task.front + "_beh.tsv");
    }
    std::string motion;
    if (recording && recording->any()) {
      motion = write_bids_motion(folder_.make(place / "motion"), task, block, session,
                                 *recording, options_.selection);
    }
    if (motion.empty()) {
      write_bids_events(folder_.make(place / "beh") / task.front, block, session, {});
    } else {
      files.push_back("motion/" + motion);
      dataset_.motion = true;
    }
    return files;
  }

  void write_sourcedata() {
    const fs::path study = folder_.make(fs::path("sourcedata") / "jnd.study");
    copy_study_database(store_, dataset_.sessions, study);
    // If only some of the samples are chosen, the full recording is not copied beside them.
    const ExportSelection& selection = options_.selection;
    if (options_.recordings && selection.blocks.empty() && selection.channels.empty() &&
        selection.rate_hz == 0.0) {
      for (const core::SessionRow& session : dataset_.sessions) {
        copy_recording(store_, session.session, study);
      }
    }
    const fs::path protocols = folder_.make(fs::path("sourcedata") / "study_files");
    std::set<std::string> names;
    for (const core::ProtocolRow& protocol : dataset_.protocols) {
      std::string name = fs::path(protocol.file_name).filename().string();
      if (name.empty() || !names.insert(name).second) {
        name = protocol.sha256.substr(0, 12) + "_" + name;
      }
      write_text(protocols / name, protocol.text);
    }
    write_device_profiles();
    write_laboratories();
  }

  void write_laboratories() {
    const std::vector<ExportedLaboratory> laboratories =
        exported_laboratories(dataset_.sessions);
    if (laboratories.empty()) return;
    const fs::path place = folder_.make(fs::path("sourcedata") / "laboratories");
    for (const ExportedLaboratory& one : laboratories) {
      write_text(place / one.file_name(), one.text);
    }
  }

  void write_device_profiles() {
    const std::vector<core::DeviceProfileRow> profiles =
        exported_profiles(store_, dataset_.sessions);
    if (profiles.empty()) return;
    const fs::path place = folder_.make(fs::path("sourcedata") / "device_profiles");
    for (const core::DeviceProfileRow& profile : profiles) {
      write_text(place / profile_file_name(profile), profile.text);
    }
  }

  const core::StudyStore& store_;
  const UnfinishedFolder& folder_;
  ExportOptions options_;
  BidsDataset dataset_;
  FactorColumns factors_;
  std::vector<Session> sessions_;
  std::map<std::string, std::string> tasks_;  ///< The label of every block and stage.
};

}  // namespace

ExportOutcome export_bids(const core::StudyStore& store, const fs::path& folder,
                          const ExportOptions& options, const std::string& results_json) {
  ExportOutcome outcome;
  write_folder(folder, [&](const UnfinishedFolder& unfinished) {
    outcome = BidsExport(store, unfinished, options).run(results_json);
  });
  return outcome;
}

}  // namespace jnd::analysis
