#include "app/results/predictive_studies.h"

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is of POSIX.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/session/pseudonym.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "core/error.h"
#include "core/random_stream.h"
#include "core/storage/sha256.h"
#include "core/storage/study_store.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

constexpr int kGroup = 52;
constexpr int kFewestGroups = 2;

/// A temporary folder, which is removed with all its contents by the destructor.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "jnd-people-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw core::Error(pattern + ": expected a folder that can be made, found none");
    }
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

std::vector<analysis::PersonOutcome> simulated_group(
    const PredictiveRequest& request, std::int64_t number, int size,
    const std::function<void(double)>& on_progress) {
  const ScratchFolder scratch;
  core::StudyStore store(scratch.path() / "group.study", core::StudyStore::Mode::kCreate,
                         core::Durability::kAtClose);
  const std::vector<std::int64_t> sessions =
      add_sessions(store,
                   {.study = request.study,
                    .laboratory = &request.laboratory,
                    .study_file = request.study.name + ".json",
                    .device = request.device,
                    .seed = core::derived_seed(request.seed, "predictive group", {number}),
                    .record = false},
                   next_participants(store, size));
  (void)run_batch({.study = request.study,
                   .laboratory = request.laboratory,
                   .store = store,
                   .sessions = sessions,
                   .jobs = request.jobs,
                   .on_progress = on_progress,
                   .is_cancelled = request.is_cancelled});
  if (request.is_cancelled && request.is_cancelled()) {
    throw core::Error("predictive: stopped before all people were simulated; none were kept");
  }
  return analysis::person_outcomes(analysis::load_study(store));
}

}  // namespace

analysis::PredictivePeople simulate_people(const PredictiveRequest& request) {
  analysis::PredictivePeople people{
      .key = {.study = request.study.name,
              .study_sha256 = core::sha256(request.study.text),
              .laboratory = request.laboratory.name,
              .laboratory_sha256 = core::sha256(request.laboratory.text),
              .device = request.device},
      .seed = request.seed};
  const int num_groups = std::max(request.num_people / kGroup, kFewestGroups);
  for (int group = 0; group < num_groups; ++group) {
    const int size =
        request.num_people * (group + 1) / num_groups - request.num_people * group / num_groups;
    people.groups.push_back(simulated_group(request, group, size, [&](double done) {
      if (request.on_progress) request.on_progress((group + done) / num_groups);
    }));
  }
  return people;
}

std::string predictive_file_name(const analysis::PredictiveKey& key) {
  return key.laboratory + "-" + key.study + ".json";
}

std::optional<analysis::PredictivePeople> shipped_people(const analysis::PredictiveKey& key) {
  const fs::path path = shipped_folder() / "data" / "predictive" / predictive_file_name(key);
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  analysis::PredictivePeople people = analysis::predictive_people_from(text, path.string());
  if (people.key != key) return std::nullopt;
  return people;
}

}  // namespace jnd::app
