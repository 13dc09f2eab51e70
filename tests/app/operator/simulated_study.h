#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/session/laboratory_run.h"
#include "app/session/pseudonym.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "app/tiny_study.h"
#include "core/storage/study_store.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

namespace jnd::app {

inline const std::string kDoubleBlindStudy =
    replaced(kTinyStudy, R"("languages")", R"("blinding": "double", "languages")");

/// A study with estimation and production in either order.
inline const std::string kCounterbalancedStudy = replaced(
    replaced(replaced(kTinyStudy, R"({"kind": "block", "name": "estimation")",
                      R"({"kind": "counterbalance", "name": "method", "method": "order",
        "arms": [{"name": "first_arm", "stages": [{"kind": "block", "name": "estimation")"),
             R"("expected_trial_s": 5},
    {"kind": "block", "name": "production")",
             R"("expected_trial_s": 5}]}, {"name": "second_arm", "stages": [
    {"kind": "block", "name": "production")"),
    R"("expected_trial_s": 5},
    {"kind": "break")",
    R"("expected_trial_s": 5}]}]},
    {"kind": "break")");

/// A study file, and a folder with sessions of simulated participants.
class SimulatedStudy {
 public:
  explicit SimulatedStudy(const std::string& text = kTinyStudy)
      : file_(write_file(temporary_.path() / "tiny.json", text)),
        study_(experiments::read_study(file_)) {}

  [[nodiscard]] std::filesystem::path temporary() const { return temporary_.path(); }
  [[nodiscard]] std::filesystem::path file() const { return file_; }
  [[nodiscard]] std::filesystem::path folder() const { return temporary_.path() / "a.study"; }
  [[nodiscard]] const experiments::Study& study() const { return study_; }

  /// Simulates complete sessions of the next participants.
  void simulate(int num_participants, bool record = false, bool pilot = false) {
    core::StudyStore store(folder(), core::StudyStore::Mode::kCreate,
                           core::Durability::kAtClose);
    SessionSetup setup = this->setup();
    setup.record = record;
    setup.pilot = pilot;
    (void)run_batch(
        {.study = study_,
         .laboratory = laboratory_,
         .store = store,
         .sessions = add_sessions(store, setup, next_participants(store, num_participants))});
  }

  /// Simulates a session that ends resumably after this many answers. Returns its number.
  std::int64_t interrupt(int num_answers, bool pilot = false) {
    core::StudyStore store(folder(), core::StudyStore::Mode::kCreate,
                           core::Durability::kAtClose);
    SessionSetup setup = this->setup();
    setup.pilot = pilot;
    const std::int64_t session =
        add_sessions(store, setup, next_participants(store, 1)).front();
    int answered = 0;
    const LaboratoryRunResult result = run_laboratory(
        {.study = study_,
         .laboratory = laboratory_,
         .store = store,
         .session = session,
         .durability = core::Durability::kAtClose,
         .on_event =
             [&](const core::EventRow& event) { answered += event.kind == "trial_answered"; },
         .is_cancelled = [&] { return answered >= num_answers; }});
    EXPECT_FALSE(result.ended);
    return session;
  }

 private:
  [[nodiscard]] SessionSetup setup() const {
    return {.study = study_, .laboratory = &laboratory_, .study_file = file_, .seed = 3};
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  std::filesystem::path file_;
  experiments::Study study_;
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
};

}  // namespace jnd::app
