#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "analysis/export/csv_export.h"
#include "core/storage/study_store.h"
#include "support/temporary_folder.h"

namespace jnd {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kNumSessions = 26, kNumTrials = 500;
// Rows of each trial: its event, its answer, and one presentation with its event.
constexpr std::int64_t kNumRows = kNumSessions * kNumTrials * 4;

/// As many sessions as both studies of the thesis, each with more trials.
class LargeStudy {
 public:
  LargeStudy() {
    core::StudyStore store(folder(), core::StudyStore::Mode::kCreate,
                           core::Durability::kAtClose);
    const std::string hash = store.add_protocol("b.json", R"({"name": "b"})");
    for (std::int64_t session = 1; session <= kNumSessions; ++session) {
      store.add_session({.participant = "P" + std::to_string(session),
                         .protocol_sha256 = hash,
                         .rate_hz = 1000.0});
      for (std::int64_t trial = 1; trial <= kNumTrials; ++trial) add(store, session, trial);
    }
  }
  [[nodiscard]] fs::path folder() const { return temporary_.path() / "large.study"; }
  [[nodiscard]] fs::path out() const { return temporary_.path() / "out"; }

 private:
  static void add(core::StudyStore& store, std::int64_t session, std::int64_t trial) {
    const std::int64_t sequence = 2 * trial;
    const double number = 1.0 / static_cast<double>(trial);
    core::Commit shown{.event = {.session = session,
                                 .sequence = sequence - 1,
                                 .kind = "presentation_ended",
                                 .trial = trial,
                                 .attempt = 1,
                                 .intensity = number}};
    shown.presentation = core::PresentationRow{
        .session = session,
        .trial = trial,
        .attempt = 1,
        .presentation = 1,
        .sequence = sequence - 1,
        .interval = "test",
        .intensity = number,
        .measures = {.stroke_width_m = number / 3.0, .max_speed_m_per_s = number / 7.0}};
    store.append(shown);
    core::Commit answered{.event = {.session = session,
                                    .sequence = sequence,
                                    .kind = "trial_answered",
                                    .trial = trial,
                                    .attempt = 1}};
    answered.trial = core::TrialRow{.session = session,
                                    .trial = trial,
                                    .attempt = 1,
                                    .sequence = sequence,
                                    .block = "estimation",
                                    .procedure = "magnitude_estimation",
                                    .medium = "water",
                                    .quantity = "scale",
                                    .intensity = number,
                                    .response = 100.0 * number,
                                    .measures = {.response_time_s = 3.0 * number}};
    store.append(answered);
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

/// Times `export csv` of a large study, including its opening.
void export_csv(benchmark::State& state) {
  const LargeStudy study;
  for (auto _ : state) {
    const core::StudyStore store(study.folder(), core::StudyStore::Mode::kReadOnly);
    analysis::export_csv(store, study.out(), {});
    state.PauseTiming();
    fs::remove_all(study.out());
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * kNumRows);
}
BENCHMARK(export_csv)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Measures the reference in the same run: the CSV of the same rows by the sqlite3 shell.
void reference_sqlite3_shell_csv(benchmark::State& state) {
  const LargeStudy study;
  const std::string command = "sqlite3 -readonly -csv -header '" +
                              (study.folder() / "study.sqlite").string() +
                              "' 'SELECT * FROM session; SELECT * FROM trial_in_force;"
                              " SELECT * FROM presentation_in_force; SELECT * FROM event;"
                              " SELECT * FROM answer_in_force;' >'" +
                              study.out().string() + "'";
  for (auto _ : state) {
    if (std::system(command.c_str()) != 0) {
      state.SkipWithError("expected the sqlite3 shell, found none; apt-get install sqlite3");
      break;
    }
  }
  state.SetItemsProcessed(state.iterations() * kNumRows);
}
BENCHMARK(reference_sqlite3_shell_csv)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace jnd
