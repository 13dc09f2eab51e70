#include "analysis/export/bids_export.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "analysis/export/bids_blocks.h"
#include "analysis/export/bids_dataset.h"
#include "analysis/export/bids_motion.h"
#include "analysis/export/bids_sourcedata.h"
#include "analysis/export/bids_text.h"
#include "analysis/export/unfinished_folder.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

BidsDataset dataset_of(const core::StudyStore& store, const ExportOptions& options) {
  BidsDataset dataset{.sessions = exported_sessions(store, options)};
  if (dataset.sessions.empty()) {
    throw core::Error(store.folder().string() + ": expected a session to export, found none" +
                      (store.sessions().empty() ? "" : " but pilots; --pilot exports them"));
  }
  std::vector<std::string> participants;
  std::set<std::string> hashes;
  for (const core::SessionRow& row : dataset.sessions) {
    participants.push_back(row.participant);
    dataset.simulated |= row.simulated;
    dataset.motion |= options.recordings && fs::exists(store.recording_file(row.session));
    if (hashes.insert(row.protocol_sha256).second) {
      dataset.protocols.push_back(store.protocol(row.protocol_sha256));
    }
  }
  dataset.subjects = bids_labels(participants);
  return dataset;
}

class Export {
 public:
  Export(const core::StudyStore& store, const UnfinishedFolder& folder,
         const ExportOptions& options)
      : store_(store),
        folder_(folder),
        options_(options),
        dataset_(dataset_of(store, options)) {}

  void run(const std::string& results_json) {
    std::vector<std::string> names;
    for (const core::SessionRow& session : dataset_.sessions) {
      for (const core::DesignRow& row : store_.design(session.session)) {
        names.push_back(row.block);
      }
    }
    tasks_ = bids_labels(std::move(names));
    write_bids_descriptions(folder_.path(), dataset_, last_time_ns());
    write_bids_participants(folder_.path(), dataset_, store_);
    std::map<std::string, int> num_visits;
    for (const core::SessionRow& session : dataset_.sessions) {
      write_session(session, ++num_visits[session.participant]);
    }
    write_sourcedata();
    write_bids_derivatives(folder_.path(), dataset_, results_json);
  }

 private:
  [[nodiscard]] std::int64_t last_time_ns() const {
    std::int64_t last = 0;
    for (const core::SessionRow& session : dataset_.sessions) {
      for (const core::SessionOverview& one : store_.overview()) {
        if (one.session == session.session) last = std::max(last, one.last_time_ns.value_or(0));
      }
    }
    return last;
  }

  void write_session(const core::SessionRow& session, int visit) {
    const std::string subject = "sub-" + dataset_.subjects.at(session.participant);
    char number[32];
    std::snprintf(number, sizeof number, "ses-%02d", visit);
    const fs::path place = fs::path(subject) / number;
    const std::string front = subject + "_" + number;
    const fs::path folder = folder_.make(place);
    CsvTableWriter scans(folder / (front + "_scans.tsv"),
                         std::vector<std::string>{"filename", "acq_time"}, TableStyle::kBids);
    for (const BidsBlock& block : bids_blocks(store_, session)) {
      const BidsTask task{.front = front + "_task-" + tasks_.at(block.block),
                          .task_name = block.block,
                          .description = block.trials.front().row.procedure + " in " +
                                         block.trials.front().row.medium +
                                         (session.simulated ? ", SIMULATED" : "")};
      // A simulated session counts its time from 0, which is no date.
      const std::string time = session.simulated ? "" : iso_time(block.time_ns);
      for (const std::string& file : write_block(place, task, block, session)) {
        scans.cell(file).cell(time).end_row();
      }
    }
    scans.finish();
  }

  /// Returns the files that a list of scans names, seen from the session's folder.
  std::vector<std::string> write_block(const fs::path& place, const BidsTask& task,
                                       const BidsBlock& block,
                                       const core::SessionRow& session) {
    const fs::path beh = folder_.make(place / "beh");
    write_bids_beh(beh, task, block);
    std::vector<std::string> files = {"beh/" + task.front + "_beh.tsv"};
    const fs::path recording = store_.recording_file(session.session);
    std::string motion;
    if (options_.recordings && fs::exists(recording)) {
      motion = write_bids_motion(folder_.make(place / "motion"), task, block, session,
                                 core::RecordingReader(recording));
    }
    if (motion.empty()) {
      write_bids_events(beh / task.front, block, session.rate_hz, {});
    } else {
      files.push_back("motion/" + motion);
    }
    return files;
  }

  void write_sourcedata() {
    const fs::path study = folder_.make(fs::path("sourcedata") / "jnd.study");
    copy_study_database(store_, dataset_.sessions, study);
    if (options_.recordings) {
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
  }

  const core::StudyStore& store_;
  const UnfinishedFolder& folder_;
  ExportOptions options_;
  BidsDataset dataset_;
  std::map<std::string, std::string> tasks_;  ///< Label of every block.
};

}  // namespace

void export_bids(const core::StudyStore& store, const fs::path& folder,
                 const ExportOptions& options, const std::string& results_json) {
  UnfinishedFolder unfinished(folder);
  Export(store, unfinished, options).run(results_json);
  unfinished.publish();
}

}  // namespace jnd::analysis
