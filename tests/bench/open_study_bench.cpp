#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/operator/study_folder.h"
#include "app/session/laboratory_run.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "core/storage/study_store.h"
#include "experiments/protocol/study_reader.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using core::StudyStore;

/// A study whose first session was simulated. The others are copies of it, and the last one was
/// interrupted half way.
class StudyOfManySessions {
 public:
  explicit StudyOfManySessions(int num_sessions)
      : store_(folder(), StudyStore::Mode::kCreate, core::Durability::kAtClose) {
    const fs::path source = test_support::source_folder();
    const fs::path file = source / "protocols" / "viscosity_discrimination.json";
    const experiments::Study study = experiments::read_study(file);
    const experiments::Laboratory laboratory =
        experiments::read_laboratory(source / "data" / "laboratories" / "thesis.json");
    (void)run_batch(
        {.study = study,
         .laboratory = laboratory,
         .store = store_,
         .sessions = add_sessions(
             store_,
             {.study = study, .laboratory = &laboratory, .study_file = file, .record = false},
             {"P001"})});
    for (int number = 2; number <= num_sessions; ++number) copy(number, number == num_sessions);
  }

  [[nodiscard]] fs::path folder() const { return temporary_.path() / "large.study"; }

 private:
  void copy(int number, bool interrupted) {
    core::SessionRow row = store_.session(1);
    row.session = 0;
    row.participant = "P" + std::to_string(1000 + number);
    const std::int64_t session = store_.add_session(row);
    // Rows are appended together with the events from which they were projected.
    std::map<std::int64_t, core::Commit> commits;
    for (core::EventRow& event : store_.events(1)) {
      event.session = session;
      commits[event.sequence].event = std::move(event);
    }
    for (core::DesignRow& design : store_.design(1)) {
      design.session = session;
      for (auto& [sequence, commit] : commits) {
        if (commit.event.kind != "trials_drawn" || commit.event.stage != design.stage) continue;
        commit.design.push_back(design);
      }
    }
    for (core::TrialRow& trial : store_.trials(1)) {
      trial.session = session;
      commits[trial.sequence].trial = trial;
    }
    for (core::PresentationRow& presentation : store_.presentations(1)) {
      presentation.session = session;
      commits[presentation.sequence].presentation = presentation;
    }
    const auto most = static_cast<std::int64_t>(commits.size() / (interrupted ? 2 : 1));
    for (const auto& [sequence, commit] : commits) {
      if (sequence <= most) store_.append(commit);
    }
  }

  test_support::TemporaryFolder temporary_;
  StudyStore store_;
};

/// Measures how everything is read that the views of the start and of the sessions show of a
/// study.
void open_study_100_sessions(benchmark::State& state) {
  const StudyOfManySessions study(100);
  std::size_t num_sessions = 0;
  for (auto _ : state) {
    const StudyFolder opened = open_study_folder(study.folder());
    num_sessions = opened.sessions.size();
    if (opened.interrupted.size() != 1) state.SkipWithError("expected one open session");
  }
  state.counters["sessions"] = static_cast<double>(num_sessions);
}
BENCHMARK(open_study_100_sessions)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::app
