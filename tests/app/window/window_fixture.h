#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/tiny_study.h"
#include "app/window/virtual_display.h"
#include "app/window/window_driver.h"
#include "core/storage/study_store.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {

/// Plays a person at the real window, on a display of the test's own. The tests are skipped
/// where no display can be made.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string lacking = what_windows_lack(); !lacking.empty()) {
      GTEST_SKIP() << lacking;
    }
    go_first();
    display_ = std::make_unique<VirtualDisplay>(1280, 720);
    window_ = std::make_unique<WindowDriver>(*display_, temporary_.path() / "person");
  }

  void TearDown() override {
    if (window_ == nullptr) return;
    const std::string texts = window_->every_text();
    const std::size_t shared = texts.find("more than one control of ");
    EXPECT_EQ(shared, std::string::npos)
        << "a key that does not do what its button says: "
        << texts.substr(shared, texts.find('\n', shared) - shared);
  }

  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return temporary_.path() / name;
  }
  [[nodiscard]] test_support::ProgramOutcome jnd(
      const std::vector<std::string>& arguments) const {
    return test_support::run_program(
        arguments, {.folder = temporary_.path(), .environment = window_->environment()});
  }

  /// Starts `jnd run` with the simulated hand, up to the card that waits for the beginning of
  /// the session.
  void prepare(const std::string& study_text, const std::string& folder = "a.study") {
    write_file(path("study.json"), study_text);
    window_->start({"run", path("study.json").string(), "--study", path(folder).string(),
                    "--participant", "P01", "--device", "lumped", "--seed", "7"});
    window_->wait_for_view("prepare");
    window_->use("real_session");
    window_->use("start_session");
    window_->wait_for("begin");
  }
  void begin(const std::string& study_text, const std::string& folder = "a.study") {
    prepare(study_text, folder);
    window_->use("begin");
  }

  /// Presents the stimuli of the current trial until the test is felt and can be answered.
  void feel_test() {
    if (window_->wait_for("present").find("present")->label == "Present the reference") {
      window_->use("present");
      window_->wait_until("the reference", [](const Screen& now) {
        return now.offers("present") && now.find("present")->label == "Present the test";
      });
    }
    window_->use("present");
    // The words alone may still be those of the reference.
    window_->wait_until("the test", [](const Screen& now) {
      return now.shows("felt for") && !now.offers("present");
    });
  }
  void wait_for_trial(int number) {
    window_->wait_until("trial " + std::to_string(number), [&](const Screen& now) {
      return now.text_after("Trial " + std::to_string(number) + " of ") != "";
    });
  }

  [[nodiscard]] core::StudyStore stored(const std::string& folder = "a.study") const {
    return {path(folder), core::StudyStore::Mode::kReadOnly};
  }
  /// Returns the answers that count, by trial.
  [[nodiscard]] static std::vector<double> responses(const core::StudyStore& store) {
    std::vector<double> all;
    for (const core::TrialRow& trial : store.trials(1)) all.push_back(*trial.response);
    return all;
  }
  [[nodiscard]] static std::vector<core::EventRow> events_of(const core::StudyStore& store,
                                                             const std::string& kind) {
    std::vector<core::EventRow> all;
    for (core::EventRow& event : store.events(1)) {
      if (event.kind == kind) all.push_back(std::move(event));
    }
    return all;
  }
  [[nodiscard]] static std::string value(const core::EventRow& event, const std::string& key) {
    const auto data = nlohmann::json::parse(event.data);
    return data.at(key).get<std::string>();
  }
  /// Returns the notes that somebody wrote, without those that say what became of an unlikely
  /// answer.
  [[nodiscard]] static std::vector<core::EventRow> written_notes(
      const core::StudyStore& store) {
    std::vector<core::EventRow> notes = events_of(store, "note_added");
    std::erase_if(notes, [](const core::EventRow& note) {
      return value(note, "text").starts_with("asked about the answer");
    });
    return notes;
  }
  void expect_verified(const std::string& folder = "a.study") const {
    const test_support::ProgramOutcome outcome = jnd({"verify", path(folder).string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  std::unique_ptr<VirtualDisplay> display_;
  std::unique_ptr<WindowDriver> window_;
};

}  // namespace jnd::app
