#include "app/session/stored_session.h"

#include <fstream>
#include <iterator>
#include <set>

#include "core/error.h"
#include "core/storage/sha256.h"
#include "experiments/order/cell.h"
#include "experiments/order/counterbalance.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"

namespace jnd::app {

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

namespace {

/// True if the study's rule has ended it, and that was told.
bool has_ended(const core::StudyStore& store) {
  const std::vector<core::SequentialLookRow> looks = store.looks();
  return !looks.empty() && looks.back().decision == "stop";
}

}  // namespace

void require_results_open(const core::StudyStore& store) {
  std::set<std::string> seen;
  for (const core::SessionRow& row : store.sessions()) {
    if (!seen.insert(row.protocol_sha256).second) continue;
    const experiments::Study study = stored_study(store, row.session);
    if (study.blinding == experiments::Blinding::kDouble && !store.unblinded()) {
      throw core::Error(store.folder().string() +
                        ": expected a study whose levels may be seen, found a double-blind one "
                        "that nobody has unblinded; `jnd unblind` does, and leaves a record");
    }
    if (study.sequential && !has_ended(store) && store.unsealings().empty()) {
      throw core::Error(store.folder().string() +
                        ": expected a study that its rule has ended, found one that looks may "
                        "still end, whose results are sealed until then; `jnd look` says "
                        "whether to go on, and keeps that it was asked");
    }
  }
}

std::string ended_study_remark(const core::StudyStore& store) {
  if (!has_ended(store)) return "";
  return store.folder().string() + ": the rule of the study ended it at look " +
         std::to_string(store.looks().back().look) + "; one session more was not planned";
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

}  // namespace jnd::app
